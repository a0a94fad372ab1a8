//! Memory follows what comes, not what is promised.

use crate::bag::ros1::buffer::read_up_to;
use proptest::prelude::*;
use std::io::Read;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_promise_takes_no_memory(given in 0_u64..1 << 20, promised in any::<u32>()) {
        let promised = u64::from(promised);
        let mut buffer = Vec::new();
        read_up_to(&mut std::io::repeat(1).take(given), &mut buffer, promised).unwrap();
        prop_assert_eq!(buffer.len() as u64, given.min(promised));
        let bound = promised.min((2 * given).max(64 << 10));
        prop_assert!(buffer.capacity() as u64 <= bound, "{} of {bound}", buffer.capacity());
    }
}
