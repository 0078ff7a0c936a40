//! Figures as pixels.

use trilith_report::{Drawing, Figure, PngError, png_is_built_in};

fn figure(title: &str) -> Figure {
    let wave = (0..200).map(|i| (0.01 * f64::from(i), (0.1 * f64::from(i)).sin()));
    Figure::new(title, "time [s]", "u [µm]").line("computed", wave).sized(500, 300)
}

#[test]
fn a_build_without_the_feature_says_so() {
    let made = Drawing::from(&figure("a")).png();
    assert_eq!(made.is_ok(), png_is_built_in());
    assert!(png_is_built_in() || made == Err(PngError::NotBuiltIn));
}

#[cfg(feature = "png")]
mod built_in {
    use super::*;

    struct Picture {
        size: (u32, u32),
        per_metre: u32,
        bytes: Vec<u8>,
    }

    impl Picture {
        fn of(figure: &Figure) -> Self {
            let file = Drawing::from(figure).png().unwrap();
            let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
            let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
            let frame = reader.next_frame(&mut bytes).unwrap();
            assert_eq!(frame.color_type, png::ColorType::Rgb);
            let per_metre = reader.info().pixel_dims.unwrap().xppu;
            Self { size: (frame.width, frame.height), per_metre, bytes }
        }

        /// Dark pixels in a box, in pixels of the figure.
        fn dark(&self, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> usize {
            let place = |x, y| 3 * (y * self.size.0 + x) as usize;
            let mut count = 0;
            for y in 2 * y.start..2 * y.end {
                for x in 2 * x.start..2 * x.end {
                    count += usize::from(self.bytes[place(x, y)..][..3].iter().all(|c| *c < 128));
                }
            }
            count
        }
    }

    #[test]
    fn it_has_the_size_promised_and_letters_where_the_title_is() {
        let picture = Picture::of(&figure("Displacement Δ of the mass"));
        assert_eq!((picture.size, picture.per_metre), ((1000, 600), 7559));
        // The title is in the middle of the first 26 lines; nothing else is.
        let title = picture.dark(130..370, 6..26);
        assert!(title > 500, "{title}");
        assert_eq!(Picture::of(&figure(" ")).dark(0..500, 0..26), 0);
        // The sheet is white, and the curve crosses it.
        assert_eq!(&picture.bytes[..3], [255; 3]);
        let blue = picture.bytes.chunks(3).filter(|c| *c == [0, 114, 178]).count();
        assert!(blue > 1000, "{blue}");
    }

    #[test]
    fn letters_beyond_ascii_are_letters_and_not_boxes() {
        // What the typeface does not have is drawn as one and the same box.
        let ink = |title: &str| Picture::of(&figure(title)).dark(0..500, 0..26);
        let missing = ink("\u{e000}\u{e000}\u{e000}\u{e000}");
        for text in ["αβγδ", "µ·²³", "≤≥−°", "ΔΣφθ", "₁₂₃₄"] {
            assert!(ink(text) > 20 && ink(text) != missing, "{text}: {} {missing}", ink(text));
        }
    }

    #[test]
    fn the_same_figure_gives_the_same_bytes() {
        assert_eq!(Drawing::from(&figure("a")).png(), Drawing::from(&figure("a")).png());
        let sizes = [(0, 300), (500, 0), (u32::MAX, 2)];
        for (w, h) in sizes {
            assert!(Drawing::from(&figure("a").sized(w, h)).png().is_err(), "{w} {h}");
        }
    }
}
