//! The dictionaries that markers are taken from.

/// A dictionary: square patterns, of which each is a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dictionary {
    name: &'static str,
    side: usize,
    words: Vec<u64>,
    correctable: u32,
}

/// A word of a dictionary that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Match {
    /// Number of the word.
    pub id: u32,
    /// By how many quarters the marker has to be turned clockwise to stand upright.
    pub quarters: usize,
}

/// Name, bits in a row, words of the table that belong to it, smallest distance between any two, how
/// text begins that also means it.
struct Row {
    name: &'static str,
    side: usize,
    count: usize,
    distance: u32,
    table: &'static str,
}

macro_rules! rows {
    ($($name:literal: $side:literal, $count:literal, $distance:literal, $table:literal;)*) => {
        [$(Row {
            name: $name,
            side: $side,
            count: $count,
            distance: $distance,
            table: include_str!(concat!("dictionary/", $table, ".txt")),
        }),*]
    };
}

/// The tables and their distances are from `dictionary/make_tables.py`.
const ROWS: [Row; 20] = rows! {
    "4x4_50": 4, 50, 4, "4x4";
    "4x4_100": 4, 100, 3, "4x4";
    "4x4_250": 4, 250, 3, "4x4";
    "4x4_1000": 4, 1000, 2, "4x4";
    "5x5_50": 5, 50, 8, "5x5";
    "5x5_100": 5, 100, 7, "5x5";
    "5x5_250": 5, 250, 6, "5x5";
    "5x5_1000": 5, 1000, 5, "5x5";
    "6x6_50": 6, 50, 13, "6x6";
    "6x6_100": 6, 100, 12, "6x6";
    "6x6_250": 6, 250, 11, "6x6";
    "6x6_1000": 6, 1000, 9, "6x6";
    "7x7_50": 7, 50, 19, "7x7";
    "7x7_100": 7, 100, 18, "7x7";
    "7x7_250": 7, 250, 17, "7x7";
    "7x7_1000": 7, 1000, 14, "7x7";
    "original": 5, 1024, 0, "original";
    "36h11": 6, 587, 11, "36h11";
    "25h9": 5, 35, 9, "25h9";
    "16h5": 4, 30, 5, "16h5";
};

/// Share of the errors that the distance lets one correct that are corrected (as OpenCV has it).
const CORRECTED: f64 = 0.6;
/// A random pattern may be taken for a word this often at most, unless the dictionary is so crowded
/// that it is more without any correction.
const MISTAKEN: f64 = 0.01;

impl Dictionary {
    /// The dictionary of that name: `4x4_50` to `7x7_1000` and `original` (ArUco), `36h11`, `25h9`,
    /// `16h5` (AprilTag). `None` if there is none.
    pub fn named(name: &str) -> Option<Self> {
        let row = ROWS.iter().find(|row| row.name == name)?;
        let word = |word| u64::from_str_radix(word, 16).expect("tables are of hexadecimal words");
        let words = row.table.split_whitespace().take(row.count).map(word).collect();
        let mut dictionary = Self { name: row.name, side: row.side, words, correctable: 0 };
        dictionary.correctable = correctable(&dictionary, row.distance);
        Some(dictionary)
    }

    /// A dictionary of a caller's own: patterns of `side` x `side` bits, row by row from the upper left
    /// corner, the first bit highest, 1 white; of which up to `correctable` wrong bits are corrected.
    ///
    /// `None` unless `side` is 3 to 8.
    pub fn custom(side: usize, words: Vec<u64>, correctable: u32) -> Option<Self> {
        (3..=8).contains(&side).then_some(Self { name: "custom", side, words, correctable })
    }

    /// Names of all dictionaries.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ROWS.iter().map(|row| row.name)
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Bits in a row of a pattern, without the border.
    pub fn side(&self) -> usize {
        self.side
    }

    /// How many markers there are: their numbers begin at 0.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// Whether it has no marker.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Whether the cell in `row` and `column` of marker `id` is white, the black border around the
    /// pattern counted; `None` if there is no such marker or cell.
    pub fn is_white(&self, id: u32, row: usize, column: usize) -> Option<bool> {
        let word = self.words.get(usize::try_from(id).ok()?)?;
        let whole = self.side + 2;
        if row >= whole || column >= whole {
            return None;
        }
        if row == 0 || column == 0 || row == whole - 1 || column == whole - 1 {
            return Some(false);
        }
        let place = (row - 1) * self.side + column - 1;
        Some(word >> (self.side * self.side - 1 - place) & 1 == 1)
    }

    /// The word that `bits` are, turned in any of four ways; `None` if none is near enough, or two are
    /// equally near (some words of `original` look the same from two sides).
    pub(crate) fn find(&self, bits: u64) -> Option<Match> {
        let mut best = (u32::MAX, Match { id: 0, quarters: 0 });
        let mut tied = false;
        let mut turned = bits;
        for quarters in 0..4 {
            for (id, word) in self.words.iter().enumerate() {
                let errors = (word ^ turned).count_ones();
                if errors <= best.0 {
                    tied = errors == best.0;
                    best = (errors, Match { id: id as u32, quarters });
                }
            }
            turned = turned_clockwise(turned, self.side);
        }
        (best.0 <= self.correctable && !tied).then_some(best.1)
    }
}

/// The pattern turned by a quarter, clockwise.
fn turned_clockwise(bits: u64, side: usize) -> u64 {
    let last = side * side - 1;
    let mut turned = 0;
    for row in 0..side {
        for column in 0..side {
            let from = (side - 1 - column) * side + row;
            turned = turned << 1 | (bits >> (last - from) & 1);
        }
    }
    turned
}

/// How many wrong bits are corrected: a share of what the distance allows, if random patterns are then
/// still seldom taken for words.
fn correctable(dictionary: &Dictionary, distance: u32) -> u32 {
    let bits = (dictionary.side * dictionary.side) as f64;
    let most = (CORRECTED * f64::from(distance.saturating_sub(1) / 2)) as u32;
    let mistaken = |errors: u32| {
        let mut patterns = 1.0;
        let mut sum = 1.0;
        for k in 0..errors {
            patterns *= (bits - f64::from(k)) / f64::from(k + 1);
            sum += patterns;
        }
        4.0 * dictionary.words.len() as f64 * sum / bits.exp2()
    };
    (0..=most).rev().find(|errors| mistaken(*errors) < MISTAKEN).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_far_apart_as_the_table_says() {
        for row in ROWS.iter().filter(|row| row.count <= 587) {
            let dictionary = Dictionary::named(row.name).unwrap();
            assert_eq!(dictionary.len(), row.count);
            let mut smallest = u32::MAX;
            for (i, word) in dictionary.words.iter().enumerate() {
                let mut turned = *word;
                for quarters in 0..4 {
                    let others = dictionary.words.iter().enumerate();
                    let others = others.filter(|(j, _)| quarters > 0 || *j != i);
                    let nearest = others.map(|(_, other)| (other ^ turned).count_ones()).min();
                    smallest = smallest.min(nearest.unwrap_or(u32::MAX));
                    turned = turned_clockwise(turned, row.side);
                }
                assert_eq!(turned, *word);
            }
            assert_eq!(smallest, row.distance, "{}", row.name);
            assert!(2 * dictionary.correctable < row.distance.max(1));
        }
    }

    #[test]
    fn words_with_as_many_errors_as_are_corrected_are_found_however_turned() {
        for row in ROWS.iter().filter(|row| row.distance > 0) {
            let dictionary = Dictionary::named(row.name).unwrap();
            for (id, word) in dictionary.words.iter().enumerate().step_by(7) {
                let mut bits = *word;
                for error in 0..dictionary.correctable as usize {
                    bits ^= 1 << ((5 * error + id) % (row.side * row.side));
                }
                for turned in 0..4 {
                    let found = dictionary.find(bits).unwrap();
                    assert_eq!((found.id as usize, (found.quarters + turned) % 4), (id, 0));
                    bits = turned_clockwise(bits, row.side);
                }
            }
        }
    }

    #[test]
    fn a_word_that_looks_the_same_from_two_sides_is_not_found() {
        let dictionary = Dictionary::custom(3, vec![0b111_101_111, 0b000_000_001], 0).unwrap();
        assert_eq!(dictionary.find(0b111_101_111), None);
        assert_eq!(dictionary.find(0b000_000_100), Some(Match { id: 1, quarters: 3 }));
    }
}
