//! What a link can break.

/// A property that does not hold. Paths are numbered from 0, times in s.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConformanceError {
    /// The kit was given another number of coordinates than the link has.
    #[error("the link has {link} coordinates, and the kit {kit} deformations")]
    Coordinates {
        /// Coordinates of the link.
        link: usize,
        /// Deformations of the kit.
        kit: usize,
    },
    /// Two history variables share a name, or one has none.
    #[error("history variable `{name}`: names must be unique and not empty")]
    FieldName {
        /// The name.
        name: String,
    },
    /// The dummy is not symmetric positive semi-definite, or not finite.
    #[error("the engaged stiffness must be symmetric positive semi-definite: row {row}, {why}")]
    EngagedStiffness {
        /// Row where it shows.
        row: usize,
        /// What is wrong there.
        why: &'static str,
    },
    /// A value is not finite, or a trial history variable was not written.
    #[error("{what}[{index}] is not finite (or not written) at t = {time} s of path {path}")]
    NotFinite {
        /// `f`, `k`, `c`, `energy` or `trial`.
        what: &'static str,
        /// Which entry.
        index: usize,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// The law has no answer, and says why.
    #[error(
        "the law has no answer at t = {time} s of path {path}: {why}; give the kit deformations at which it has one"
    )]
    Refuses {
        /// Its own words.
        why: String,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// Equal questions got different answers.
    #[error(
        "{what}[{index}] was {first:e}, and {second:e} when asked again, at t = {time} s of path {path}"
    )]
    Impure {
        /// `f`, `k`, `c`, `energy` or `trial`.
        what: &'static str,
        /// Which entry.
        index: usize,
        /// First answer.
        first: f64,
        /// Second answer.
        second: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// A law that says it does not look at rates answers otherwise when they change.
    #[error(
        "`uses_rates` is false, but the answer depends on rates at t = {time} s of path {path}"
    )]
    UsesRates {
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// The force at the start of a step is not that of the end of the last one.
    #[error(
        "f[{index}] = {before:e} at the end of a step and {after:e} at the start of the next, at t = {time} s of path {path}"
    )]
    Restart {
        /// Coordinate.
        index: usize,
        /// Force at the end of the step.
        before: f64,
        /// Force at the start of the next, with dt = 0.
        after: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// A tangent is not the derivative of the force.
    #[error(
        "{which}[{row}][{column}] = {given:e}, and the difference quotient is {quotient:e}, at t = {time} s of path {path}"
    )]
    Tangent {
        /// `k` or `c`.
        which: &'static str,
        /// Row.
        row: usize,
        /// Column.
        column: usize,
        /// What the law says.
        given: f64,
        /// Central difference quotient.
        quotient: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// A form for lanes with another history than the law.
    #[error("the form for lanes has {given} history variables, and the link {own}")]
    LaneHistory {
        /// Variables of the form.
        given: usize,
        /// Variables of the link.
        own: usize,
    },
    /// Another form of the law answers otherwise than the law.
    #[error(
        "`{form}`: {what}[{index}] = {given:e}, and `respond` gives {own:e}, at t = {time} s of path {path}"
    )]
    Form {
        /// `lanes` or `damping_constant`.
        form: &'static str,
        /// `f`, `k`, `c`, `energy` or `trial`.
        what: &'static str,
        /// Which entry.
        index: usize,
        /// What the form says.
        given: f64,
        /// What the law says.
        own: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// The force has kinks nearly everywhere.
    #[error(
        "{skipped} of {of} difference quotients lie at kinks: the tangents could not be examined"
    )]
    Kinks {
        /// Columns at kinks.
        skipped: usize,
        /// All columns.
        of: usize,
    },
    /// A dissipation is negative.
    #[error(
        "{which} = {value:e} J in one step: must not be negative, at t = {time} s of path {path}"
    )]
    NegativeDissipation {
        /// `hysteretic` or `viscous`.
        which: &'static str,
        /// The increment.
        value: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
    /// Work and energies do not balance.
    #[error(
        "path {path}: work {work:e} J until t = {time} s, but stored + hysteretic + viscous = {accounted:e} J with {steps} steps a cycle"
    )]
    Balance {
        /// Number of the path.
        path: usize,
        /// When the two are farthest apart.
        time: f64,
        /// Work done on the link.
        work: f64,
        /// What it accounts for.
        accounted: f64,
        /// Steps of a cycle.
        steps: usize,
    },
    /// More energy came out than was put in.
    #[error(
        "path {path}: {gain:e} J more came out than was put in, while {turned_over:e} J went in and out"
    )]
    GivesEnergy {
        /// Number of the path.
        path: usize,
        /// Energy given.
        gain: f64,
        /// Sum of the absolute work of the steps.
        turned_over: f64,
    },
    /// A law declared independent of rates depends on them, or on the step.
    #[error("path {path}: f[{index}] = {first:e}, and {second:e} {change}")]
    DependsOnRate {
        /// Number of the path.
        path: usize,
        /// Coordinate.
        index: usize,
        /// Force before the change.
        first: f64,
        /// Force after it.
        second: f64,
        /// What was changed.
        change: &'static str,
    },
    /// A contact reports what cannot be.
    #[error("the contact reports {what} = {value:e} at t = {time} s of path {path}")]
    Contact {
        /// Which entry.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Number of the path.
        path: usize,
        /// Time.
        time: f64,
    },
}
