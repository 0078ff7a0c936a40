//! What is asked of a row.

use super::database::{Entry, Field};

impl<'a> Entry<'a> {
    fn field(&self, key: &str) -> Option<&'a Field> {
        let field = self.row.fields.iter().find(|f| f.key == key)?;
        field.used.set(true);
        Some(field)
    }

    /// A text; none where the field is not there.
    pub fn text(&self, key: &str) -> Option<&'a str> {
        self.field(key).map(|f| f.value.as_str())
    }

    /// A text that must be there; empty where it is not.
    pub fn need(&self, key: &str) -> &'a str {
        self.text(key).unwrap_or_else(|| {
            self.missing(key);
            ""
        })
    }

    fn missing(&self, key: &str) {
        self.wrong(&format!("this row has no `{key}`"), &format!("`{key}=…` belongs to it"));
    }

    /// A finite number; none where the field is not there.
    pub fn number(&self, key: &str) -> Option<f64> {
        let field = self.field(key)?;
        match field.value.parse::<f64>() {
            Ok(x) if x.is_finite() => Some(x),
            _ => {
                let message = format!("`{}` is no number", field.value);
                let help = format!("`{key}` takes a number such as 2.5 or 1E-05");
                self.db.wrong(&field.span, &message, &help);
                None
            }
        }
    }

    /// A number, 0 where there is none.
    pub fn or_zero(&self, key: &str) -> f64 {
        self.number(key).unwrap_or(0.0)
    }

    /// A number that must be there.
    pub fn need_number(&self, key: &str) -> f64 {
        if self.field(key).is_none() {
            self.missing(key);
        }
        self.or_zero(key)
    }

    /// `Yes`; false where the field is `No` or not there.
    pub fn yes(&self, key: &str) -> bool {
        let Some(field) = self.field(key) else { return false };
        match field.value.as_str() {
            "Yes" => true,
            "No" => false,
            other => {
                let message = format!("`{other}` is neither Yes nor No");
                self.db.wrong(&field.span, &message, "");
                false
            }
        }
    }

    /// Takes all fields for asked: none of the others means anything here.
    pub fn idle(&self) {
        self.row.fields.iter().for_each(|f| f.used.set(true));
    }

    /// Notes an error of the row.
    pub fn wrong(&self, message: &str, help: &str) {
        self.db.wrong(&self.row.span, message, help);
    }

    /// Notes an error of a field.
    pub fn wrong_at(&self, key: &str, message: &str, help: &str) {
        let span = self.field(key).map_or(&self.row.span, |f| &f.span);
        self.db.wrong(span, message, help);
    }
}
