//! The catalogue: what every kind of a registry is and takes, from its card.
//!
//! ```
//! let kinds = trilith::registry();
//! assert!(trilith::catalogue::markdown(&kinds).contains("### Gap"));
//! assert!(trilith::catalogue::html(&kinds).contains("<svg"));
//! ```

mod html;
mod markdown;
mod words;

pub use html::html;
pub use markdown::markdown;
pub use words::{category, nodes, parameter};

use crate::element::{Card, Category};
use crate::exercise::Specimen;
use crate::model::Registry;

/// Categories in the order of the catalogue, with what their members do.
pub const CATEGORIES: [(Category, &str); 6] = [
    (Category::Linear, "linear elements: add to M, C, K"),
    (Category::Constraint, "constraints: eliminate directions"),
    (Category::Link, "links: nonlinear laws"),
    (Category::Function, "functions of time: loads and motions"),
    (Category::Output, "outputs: numbers made of other outputs"),
    (Category::Solver, "solvers: rules for time"),
];

/// What every link takes beside its parameters.
pub const EVERY_LINK: &str =
    "Every link also takes `axis1`, `axis2`, `shear_at`, `p_delta_at` and `effective_stiffness`.";

/// Heads of a table of [`parameter`] rows.
pub const HEADS: [&str; 6] = ["name", "symbol", "unit", "range", "default", "meaning"];

/// Coordinates and history variables of a link with the parameters of its example; none for kinds
/// without a law and for a card whose example is no link.
#[must_use]
pub fn law_facts(registry: &Registry, card: &Card) -> Option<[String; 2]> {
    let specimen = Specimen::new(registry, card.kind, &[]).ok()?;
    let coordinates: Vec<_> = specimen.coordinates().into_iter().map(|c| c.name).collect();
    let fields = specimen.law.history();
    let history: Vec<_> = fields
        .iter()
        .map(
            |f| if f.unit == "1" { f.name.to_string() } else { format!("{} [{}]", f.name, f.unit) },
        )
        .collect();
    let history = if history.is_empty() { "none".to_owned() } else { history.join(", ") };
    Some([coordinates.join(", "), history])
}

/// The cards of a category.
fn of(registry: &Registry, category: Category) -> impl Iterator<Item = &'static Card> {
    registry.cards().filter(move |c| c.category == category)
}
