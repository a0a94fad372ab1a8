//! Occupied voxels by bricks of 4 x 4 x 4: a bit each, so that a brick is one word and a voxel's
//! row is a count of bits.

/// Bits of a Morton code inside a brick.
const INSIDE: u32 = 6;
/// Above the code of a brick in its key: the item of the batch.
const ITEM_SHIFT: u32 = 54;
/// In the table, a place that is free.
const FREE: u32 = u32::MAX;

/// One brick that holds something.
#[derive(Clone, Copy, Debug)]
pub struct Brick {
    /// Item and Morton code of the brick.
    pub key: u64,
    /// Its voxels, by the last bits of their codes.
    pub occupied: u64,
    /// Row of its first voxel.
    pub first: u32,
}

impl Brick {
    /// Item and Morton code (in bricks) of this one.
    pub fn place(&self) -> (u32, u64) {
        ((self.key >> ITEM_SHIFT) as u32, self.key & ((1 << ITEM_SHIFT) - 1))
    }
}

/// All bricks, in order, and a table to find them by.
#[derive(Clone, Debug, Default)]
pub struct Bricks {
    list: Vec<Brick>,
    table: Vec<u32>,
    shift: u32,
}

impl Bricks {
    /// Of items and Morton codes in order.
    pub fn new(voxels: impl Iterator<Item = (u32, u64)>) -> Self {
        let mut list: Vec<Brick> = Vec::new();
        for (row, (item, code)) in voxels.enumerate() {
            let key = (u64::from(item) << ITEM_SHIFT) | (code >> INSIDE);
            let bit = 1 << (code & ((1 << INSIDE) - 1));
            match list.last_mut() {
                Some(last) if last.key == key => last.occupied |= bit,
                _ => list.push(Brick { key, occupied: bit, first: row as u32 }),
            }
        }
        let size = (2 * list.len()).next_power_of_two().max(2);
        let mut bricks =
            Self { list: Vec::new(), table: vec![FREE; size], shift: 64 - size.trailing_zeros() };
        for (index, brick) in list.iter().enumerate() {
            let mut at = bricks.start(brick.key);
            while bricks.table[at] != FREE {
                at = (at + 1) & (size - 1);
            }
            bricks.table[at] = index as u32;
        }
        bricks.list = list;
        bricks
    }

    /// In Morton order, item after item.
    pub fn list(&self) -> &[Brick] {
        &self.list
    }

    /// The brick of an item with this Morton code (in bricks).
    pub fn find(&self, item: u32, code: u64) -> Option<&Brick> {
        let key = (u64::from(item) << ITEM_SHIFT) | code;
        let mut at = self.start(key);
        loop {
            let index = self.table[at];
            if index == FREE {
                return None;
            }
            let brick = &self.list[index as usize];
            if brick.key == key {
                return Some(brick);
            }
            at = (at + 1) & (self.table.len() - 1);
        }
    }

    /// The row of the voxel with this Morton code.
    pub fn row(&self, item: u32, code: u64) -> Option<u32> {
        let brick = self.find(item, code >> INSIDE)?;
        let bit = 1_u64 << (code & ((1 << INSIDE) - 1));
        let before = (brick.occupied & (bit - 1)).count_ones();
        (brick.occupied & bit != 0).then_some(brick.first + before)
    }

    /// Multiplicative hashing (Knuth, *The Art of Computer Programming* 3, 6.4) by the golden ratio.
    fn start(&self, key: u64) -> usize {
        (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> self.shift) as usize
    }
}
