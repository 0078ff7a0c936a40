//! The table that the documentation of `PARAMETERS` is.

use crate::field::{Choices, Field, Said, Shape};
use quote::ToTokens;
use syn::{Expr, LitStr};

/// A table in Markdown with a row for each parameter.
pub(crate) fn of(fields: &[Field]) -> String {
    let mut text = String::from("The parameters of the card.\n\n");
    text.push_str(
        "| parameter | symbol | unit | range | default | meaning |\n|---|---|---|---|---|---|\n",
    );
    for field in fields {
        let cells = [
            format!("`{}`", field.name),
            field.symbol.clone(),
            units(&field.said),
            range(field),
            default(field),
            field.meaning.clone(),
        ];
        text.push_str(&format!("| {} |\n", cells.map(|c| c.replace('|', "\\|")).join(" | ")));
    }
    text
}

fn units(said: &Said) -> String {
    let Some(unit) = &said.unit else { return String::new() };
    match (&said.about, &said.per) {
        (Some(about), _) => format!("{}, {}", unit.value(), about.value()),
        (_, Some(per)) => format!("{}/({})ᵉ", unit.value(), per.value()),
        _ => unit.value(),
    }
}

fn range(field: &Field) -> String {
    let said = &field.said;
    if let Some(choices) = &said.choices {
        return choice(choices);
    }
    match &said.range {
        Some(range) => bounds(range),
        None if said.unit.is_some() => "any".into(),
        None => String::new(),
    }
}

/// Bounds as the catalogue writes them.
fn bounds(range: &Expr) -> String {
    let plain = |e: &Expr| e.to_token_stream().to_string();
    match range {
        Expr::Path(path) if path.path.is_ident("Positive") => "> 0".into(),
        Expr::Path(path) if path.path.is_ident("NonNegative") => "≥ 0".into(),
        Expr::Call(call) if call.args.len() == 2 => {
            let (low, high) = (plain(&call.args[0]), plain(&call.args[1]));
            let above = plain(&call.func) == "Above";
            if above { format!("> {low}, ≤ {high}") } else { format!("{low} … {high}") }
        }
        other => plain(other),
    }
}

fn choice(choices: &Choices) -> String {
    match choices {
        Choices::Listed(names) => names.iter().map(LitStr::value).collect::<Vec<_>>().join(", "),
        Choices::Of(path) => format!("`{}`", path.to_token_stream().to_string().replace(' ', "")),
    }
}

fn default(field: &Field) -> String {
    match &field.said.default {
        Some(value) => value.to_token_stream().to_string().replace('"', ""),
        None if field.said.optional => "absent".into(),
        None if matches!(field.shape, Shape::Flag) => "false".into(),
        None => "required".into(),
    }
}
