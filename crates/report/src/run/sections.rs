//! The sections of the page of a run.

/// Their ids, which are links in the page, and their heads.
pub(crate) const SECTIONS: [(&str, &str); 12] = [
    ("motion", "Model and motion"),
    ("peaks", "Peaks"),
    ("ground", "Ground motion"),
    ("histories", "Time histories"),
    ("profiles", "Over the height"),
    ("members", "Forces along members"),
    ("plan", "Paths in plan"),
    ("floors", "Floor spectra"),
    ("energy", "Energy"),
    ("loops", "Hysteresis loops"),
    ("modes", "Mode shapes"),
    ("settings", "Settings and work"),
];

/// Which sections of the page of a run are wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sections(Option<Vec<String>>);

impl Sections {
    /// All that the run has something for.
    #[must_use]
    pub fn all() -> Self {
        Self(None)
    }

    /// Those of these ids. What is no id of a section wants nothing.
    #[must_use]
    pub fn of(ids: Vec<String>) -> Self {
        Self(Some(ids))
    }

    /// True where nothing is left out.
    #[must_use]
    pub fn are_all(&self) -> bool {
        self.0.is_none()
    }

    /// Whether the section of this id is wanted.
    #[must_use]
    pub fn have(&self, id: &str) -> bool {
        self.0.as_ref().is_none_or(|ids| ids.iter().any(|own| own == id))
    }
}
