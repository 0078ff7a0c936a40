//! Models made by programs, block by block.

use crate::{Diagnostics, Registry};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trilith_model::ron_value::{Ron, quoted};
use trilith_model::{Model, ModelText};

/// A word of a model file, which stands without quotes: an axis, a choice, `Fixed`.
#[must_use]
pub fn word(word: &str) -> Ron {
    Ron::word(word)
}

/// A block of a model file, `Kind(field: value, …)`: fields come by [`Ron::with`]. Without a name, `(field: value, …)`.
#[must_use]
pub fn block(kind: &str) -> Ron {
    Ron::block(kind)
}

/// A model in the making, block by block in the words of a model file.
///
/// What is made goes through the reader of files, so it knows all kinds, units, defaults and expressions, and finds all
/// errors at once, in lines of [`to_ron`](Self::to_ron).
///
/// ```
/// use trilith::{ModelBuilder, block, word};
///
/// let model = ModelBuilder::new("Swing")
///     .field("plane", word("XZ"))
///     .node("top", [0.0, 0.0, 1.0])
///     .node("base", [0.0, 0.0, 0.0])
///     .support("base", word("Fixed"))
///     .element("mass", block("Mass").with("node", "top").with("mass", (1.0, "kg")))
///     .element(
///         "spring",
///         block("Spring").with("nodes", ["base", "top"]).with("k1", 1e3).with("k2", "39.4784 N/m").with("r2", 1.0).with("r3", 1.0),
///     )
///     .case(
///         "swing",
///         block("Dynamic").with("duration", (2.0, "s")).with("dt", 0.01).with(
///             "initial",
///             vec![block("").with("node", "top").with("dof", word("Ux")).with("displacement", "2 cm")],
///         ),
///     )
///     .output("sway", block("Displacement").with("node", "top").with("dof", word("Ux")))
///     .build(&trilith::registry())
///     .expect("a model");
/// let sway = trilith::run(&model, "swing").expect("a run").peak("sway").expect("an output");
/// assert!((sway.max - 0.02).abs() < 1e-4);
///
/// let wrong = ModelBuilder::new("Nothing").output("x", block("Displacement").with("node", "top"));
/// let told = wrong.build(&trilith::registry()).unwrap_err().to_string();
/// assert!(told.contains("model.ron:4:33") && told.contains("there is no node `top`"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ModelBuilder {
    title: String,
    folder: PathBuf,
    fields: Vec<(String, Ron)>,
    /// Sections by name, in the order in which they were begun, with their entries by name.
    sections: Vec<(String, Vec<(String, Ron)>)>,
}

impl ModelBuilder {
    /// A model without anything.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            folder: PathBuf::new(),
            fields: Vec::new(),
            sections: Vec::new(),
        }
    }

    /// With a folder in which files are looked for that the model names; without, the present one.
    #[must_use]
    pub fn in_folder(mut self, folder: impl AsRef<Path>) -> Self {
        folder.as_ref().clone_into(&mut self.folder);
        self
    }

    /// With a field of the model itself, such as `plane`, `units`, `damping` or `p_delta`.
    #[must_use]
    pub fn field(mut self, name: &str, value: impl Into<Ron>) -> Self {
        self.fields.push((name.to_owned(), value.into()));
        self
    }

    /// With an entry of a section: `nodes`, `properties`, `loads`, `groups` or whatever else a model file has.
    #[must_use]
    pub fn entry(mut self, section: &str, name: &str, value: impl Into<Ron>) -> Self {
        let at = self.sections.iter().position(|(name, _)| name == section).unwrap_or_else(|| {
            self.sections.push((section.to_owned(), Vec::new()));
            self.sections.len() - 1
        });
        self.sections[at].1.push((name.to_owned(), value.into()));
        self
    }

    /// With a parameter.
    #[must_use]
    pub fn parameter(self, name: &str, value: impl Into<Ron>) -> Self {
        self.entry("parameters", name, value)
    }

    /// With a node at a place, in the model's unit of length: m where none is set.
    #[must_use]
    pub fn node(self, name: &str, at: [f64; 3]) -> Self {
        self.entry("nodes", name, at)
    }

    /// With a support.
    #[must_use]
    pub fn support(self, node: &str, held: impl Into<Ron>) -> Self {
        self.entry("supports", node, held)
    }

    /// With an element, a constraint or a link.
    #[must_use]
    pub fn element(self, name: &str, block: impl Into<Ron>) -> Self {
        self.entry("elements", name, block)
    }

    /// With a function of time.
    #[must_use]
    pub fn function(self, name: &str, block: impl Into<Ron>) -> Self {
        self.entry("functions", name, block)
    }

    /// With a case.
    #[must_use]
    pub fn case(self, name: &str, block: impl Into<Ron>) -> Self {
        self.entry("cases", name, block)
    }

    /// With an output.
    #[must_use]
    pub fn output(self, name: &str, block: impl Into<Ron>) -> Self {
        self.entry("outputs", name, block)
    }

    /// The model as a file.
    #[must_use]
    pub fn to_ron(&self) -> String {
        let mut out = format!("(\n    title: {},\n", quoted(&self.title));
        for (name, value) in &self.fields {
            let _ = writeln!(out, "    {name}: {value},");
        }
        for (section, entries) in &self.sections {
            let _ = writeln!(out, "    {section}: {{");
            for (name, value) in entries {
                let _ = writeln!(out, "        {}: {value},", quoted(name));
            }
            out.push_str("    },\n");
        }
        out.push_str(")\n");
        out
    }

    /// The model as a text that is read many times with other values of its parameters: for studies, derivatives and
    /// optimisation.
    ///
    /// # Errors
    /// What no model file has at all.
    pub fn text(&self) -> Result<ModelText, Diagnostics> {
        Ok(ModelText::new(&self.to_ron(), self.path())?)
    }

    /// The model.
    ///
    /// # Errors
    /// All errors at once.
    pub fn build(&self, registry: &Registry) -> Result<Model, Diagnostics> {
        crate::read_text(&self.to_ron(), self.path(), registry, &[])
    }

    /// What errors call the file that is none.
    fn path(&self) -> PathBuf {
        self.folder.join("model.ron")
    }
}
