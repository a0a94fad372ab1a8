use crate::strategies::config;
use eyebolt_geometry::{ImageError, Mask};
use proptest::collection::vec;
use proptest::prelude::*;

fn mask() -> impl Strategy<Value = Mask> {
    (1..14_u32, 1..14_u32).prop_flat_map(|(width, height)| {
        let pixels = (width * height) as usize;
        vec(prop::bool::weighted(0.2), pixels)
            .prop_map(move |set| Mask::new(width, height, set).unwrap())
    })
}

/// By definition, pixel by pixel.
fn slowly_dilated(mask: &Mask, radius: u32) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let any = |u: u32, v: u32| {
        (v.saturating_sub(radius)..=v.saturating_add(radius).min(height - 1)).any(|y| {
            (u.saturating_sub(radius)..=u.saturating_add(radius).min(width - 1))
                .any(|x| mask.at(x, y))
        })
    };
    let set = (0..height).flat_map(|v| (0..width).map(move |u| (u, v))).map(|(u, v)| any(u, v));
    Mask::new(width, height, set.collect()).unwrap()
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn dilation_is_what_it_says(mask in mask(), radius in prop_oneof![0..16_u32, Just(u32::MAX)]) {
        prop_assert_eq!(mask.dilated(radius), slowly_dilated(&mask, radius));
    }

    #[test]
    fn erosion_is_dilation_of_the_rest(mask in mask(), radius in 0..16_u32) {
        prop_assert_eq!(mask.eroded(radius), mask.inverted().dilated(radius).inverted());
    }

    #[test]
    fn radii_add_up(mask in mask(), a in 0..5_u32, b in 0..5_u32) {
        prop_assert_eq!(mask.dilated(a).dilated(b), mask.dilated(a + b));
        prop_assert_eq!(mask.eroded(a).eroded(b), mask.eroded(a + b));
    }

    #[test]
    fn count_is_the_number_of_pixels_set(mask in mask()) {
        let pixels = (0..mask.height()).flat_map(|v| (0..mask.width()).map(move |u| (u, v)));
        prop_assert_eq!(mask.count(), pixels.filter(|(u, v)| mask.at(*u, *v)).count());
        prop_assert_eq!(mask.count() + mask.inverted().count(), mask.as_slice().len());
    }
}

#[test]
fn a_mask_fits_its_size() {
    let error = ImageError::Size { width: 2, height: 2, values: 3 };
    assert_eq!(Mask::new(2, 2, vec![true; 3]), Err(error));
    assert!(Mask::new(0, 2, vec![]).is_err());
    assert!(Mask::new(u32::MAX, u32::MAX, vec![true]).is_err());
    assert!(!Mask::new(1, 1, vec![true]).unwrap().at(1, 0));
}
