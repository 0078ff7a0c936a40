//! A drawing that is a file of its own.

use crate::{Figure, PngError};

/// A figure, or the model, as it is written to a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    svg: String,
    size: (u32, u32),
}

impl Drawing {
    /// An SVG document with its width and height, px.
    pub(crate) fn new(svg: String, size: (u32, u32)) -> Self {
        Self { svg, size }
    }

    /// The document as SVG.
    #[must_use]
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// The same as a PNG file with twice as many pixels each way, 192 to the inch. The letters are built in: the same
    /// drawing gives the same bytes on any machine.
    ///
    /// # Errors
    /// [`PngError`] in a build without the feature `png`, and for sizes that cannot be drawn.
    pub fn png(&self) -> Result<Vec<u8>, PngError> {
        crate::png::png(&self.svg, self.size)
    }
}

impl From<&Figure> for Drawing {
    fn from(figure: &Figure) -> Self {
        Self::new(figure.svg(), figure.size)
    }
}
