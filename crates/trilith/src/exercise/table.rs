//! The path as a table.

use super::Record;
use std::fmt::Write;

impl Record {
    /// The path as CSV: a line a step, names and units in the first. Numbers read back to the same bits.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut heads = vec!["t [s]".to_owned()];
        let mut columns: Vec<&[f64]> = vec![&self.time];
        for (what, lists, units) in [
            ("d", &self.deformation, ["m", "rad"]),
            ("v", &self.rate, ["m/s", "rad/s"]),
            ("f", &self.force, ["N", "N·m"]),
        ] {
            for (c, list) in self.coordinates.iter().zip(lists) {
                heads.push(format!("{what} {} [{}]", c.name, units[usize::from(c.rotation)]));
                columns.push(list);
            }
        }
        heads.push("work [J]".into());
        columns.push(&self.work);
        for (name, list) in ["stored", "hysteretic", "viscous"].iter().zip(&self.energy) {
            heads.push(format!("{name} [J]"));
            columns.push(list);
        }
        for (field, list) in self.fields.iter().zip(&self.history) {
            heads.push(format!("{} [{}]", field.name, field.unit));
            columns.push(list);
        }
        let mut out = heads.join(",") + "\n";
        for step in 0..self.time.len() {
            for (i, column) in columns.iter().enumerate() {
                let comma = if i == 0 { "" } else { "," };
                // Writing into a string does not fail.
                let _ = write!(out, "{comma}{:?}", column[step]);
            }
            out.push('\n');
        }
        out
    }
}
