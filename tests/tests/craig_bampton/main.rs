//! A part of a model by few rows: against the equations done densely, closed forms, and the whole model.

mod dense;
mod whole;

mod refused;
