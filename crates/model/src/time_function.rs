//! Time functions: analytic pulses and tables.

/// Which limit to take where a function jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Limit from earlier times: the end of a step.
    Before,
    /// Limit from later times: the start of a step.
    After,
}

/// A function of time; zero before `start` and after its end. Frequencies in Hz.
#[derive(Clone, Debug, PartialEq)]
pub enum TimeFunction {
    /// placeholder
    Constant(f64),
}

impl TimeFunction {
    /// Value at t.
    #[must_use]
    pub fn value(&self, _t: f64, _side: Side) -> f64 {
        let Self::Constant(c) = self;
        *c
    }
    /// First and second derivative.
    #[must_use]
    pub fn derivatives(&self, _t: f64, _side: Side) -> (f64, f64) {
        (0.0, 0.0)
    }
    /// Times at which a step must end.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
    /// Largest |value|.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let Self::Constant(c) = self;
        c.abs()
    }
}
