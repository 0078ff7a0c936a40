//! The JSON Schema of model files in JSON, written from the tables that the reader itself uses.
//!
//! A number may be an expression in a text, and a name may hold an index in braces, so a schema knows less than the reader: what
//! it refuses is wrong, what it lets through need not be right.

use crate::Registry;
use serde_json::{Map, Value, json};
use trilith_element::{Card, Category, Default as CardDefault, Form};
use trilith_model::schema::{self, Block, Default, Field, Group, Takes};

/// The dialect.
const DIALECT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The JSON Schema of models with the kinds of a registry.
#[must_use]
pub fn json_schema(registry: &Registry) -> Value {
    let mut defs = Map::new();
    for group in schema::groups() {
        defs.insert(key(group), one_of(group));
    }
    if let Some(all) =
        defs.get_mut(&key(&schema::FUNCTIONS)).and_then(|d| d["anyOf"].as_array_mut())
    {
        all.extend(registry.functions().map(function));
    }
    if let Some(all) = defs.get_mut(&key(&schema::OUTPUTS)).and_then(|d| d["anyOf"].as_array_mut())
    {
        all.extend(registry.outputs().map(output));
    }
    if let Some(all) = solvers(&mut defs) {
        all.extend(registry.solvers().map(solver));
    }
    defs.insert("for".into(), repetition());
    defs.insert("element".into(), elements(registry));
    let model = schema::MODEL.blocks[0];
    let mut root = object(model);
    if let Some(Value::Object(fields)) = root.get_mut("properties") {
        for name in ["elements", "properties"] {
            let text = description(model, name);
            fields.insert(name.into(), described(map_of(reference("element")), &text));
        }
        let place = json!({ "type": "array", "minItems": 3, "maxItems": 3 });
        fields.insert("nodes".into(), described(map_of(place), &description(model, "nodes")));
        let force = any([def(&schema::LOADINGS), reference("for")]);
        let pattern = json!({ "type": "array", "items": force });
        fields.insert("loads".into(), described(map_of(pattern), &description(model, "loads")));
    }
    root["$schema"] = DIALECT.into();
    root["title"] = "A model of Trilith".into();
    root["$defs"] = Value::Object(defs);
    root
}

fn key(group: &Group) -> String {
    group.name.replace(' ', "-")
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

fn def(group: &Group) -> Value {
    reference(&key(group))
}

fn any<const N: usize>(of: [Value; N]) -> Value {
    json!({ "anyOf": of.to_vec() })
}

/// A map from names; each of its values may be made by `For`.
fn map_of(value: Value) -> Value {
    json!({ "type": "object", "additionalProperties": any([value, reference("for")]) })
}

fn described(mut value: Value, text: &str) -> Value {
    value["description"] = text.into();
    value
}

fn description(block: &Block, name: &str) -> String {
    let field = block.fields.iter().find(|f| f.name == name);
    field.map_or_else(String::new, |f| f.meaning.to_owned())
}

/// `{"For": {…}}`: what is repeated is told by where it stands, and not looked at.
fn repetition() -> Value {
    json!({
        "type": "object",
        "properties": { "For": { "type": "object", "required": ["of"] } },
        "required": ["For"],
        "additionalProperties": false,
    })
}

fn one_of(group: &Group) -> Value {
    let all: Vec<Value> = group.blocks.iter().flat_map(|b| forms(b)).collect();
    let what = match <[Value; 1]>::try_from(all) {
        Ok([only]) => only,
        Err(all) => json!({ "anyOf": all }),
    };
    described(what, group.meaning)
}

/// The ways to write a block.
fn forms(block: &Block) -> Vec<Value> {
    if block.name.is_empty() {
        let mut all = vec![object(block)];
        // Parts of a combination, loads of a case, sections: a name alone may do.
        if block.fields.iter().any(|f| matches!(f.takes, Takes::Name(_))) {
            all.push(json!({ "type": "string" }));
        }
        return all;
    }
    let mut all = vec![named(block.name, object(block), block.meaning)];
    let needed = |f: &Field| matches!(f.default, Default::Required);
    if !block.fields.iter().any(needed) {
        all.push(json!({ "const": block.name }));
    }
    if block.name == schema::ROLLED.name {
        all.push(json!({ "type": "string" }));
    }
    all
}

/// `{"Name": …}`: fields, or the values alone where a name takes them so.
fn named(name: &str, fields: Value, meaning: &str) -> Value {
    let value = any([fields, json!({ "type": ["array", "number", "string"] })]);
    json!({
        "type": "object",
        "description": meaning,
        "properties": { name: value },
        "required": [name],
        "additionalProperties": false,
    })
}

fn object(block: &Block) -> Value {
    let fields: Map<String, Value> = block.fields.iter().map(property).collect();
    let needed = block.fields.iter().filter(|f| matches!(f.default, Default::Required));
    let needed: Vec<&str> = needed.map(|f| f.name).collect();
    json!({
        "type": "object",
        "properties": fields,
        "required": needed,
        "additionalProperties": false,
    })
}

fn property(field: &Field) -> (String, Value) {
    let default = match field.default {
        Default::Value(text) => format!(" Default: {text}."),
        Default::Absent(words) => format!(" Without it: {words}."),
        Default::Required => String::new(),
    };
    (field.name.to_owned(), described(value(field.takes), &format!("{}{default}", field.meaning)))
}

fn value(takes: Takes) -> Value {
    match takes {
        Takes::Text => json!({ "type": "string" }),
        Takes::Number(..) | Takes::Quantity | Takes::Count(_) => number(),
        Takes::Flag => json!({ "type": ["boolean", "number", "string"] }),
        Takes::Choice(names) => choice(names),
        Takes::Name(_) => json!({ "type": ["string", "array"] }),
        Takes::One(group) => def(group),
        Takes::List(group) => {
            let items = any([def(group), reference("for")]);
            any([json!({ "type": "array", "items": items }), def(group)])
        }
        Takes::Map(group) => map_of(def(group)),
        Takes::Words(_) => json!({}),
    }
}

/// A number, or an expression.
fn number() -> Value {
    json!({ "type": ["number", "string"] })
}

/// One of these names, or a text that stands for one: an index in braces, a parameter.
fn choice(names: &[&str]) -> Value {
    any([json!({ "enum": names }), json!({ "type": "string" })])
}

fn elements(registry: &Registry) -> Value {
    let kinds: Vec<Value> = registry.elements().map(element).collect();
    json!({ "anyOf": kinds, "description": "An element, a constraint or a link." })
}

fn parameters(card: &Card) -> impl Iterator<Item = (String, Value)> {
    card.parameters.iter().map(|p| {
        let what = match p.form {
            Form::Choice(names) => choice(names),
            Form::Flag => value(Takes::Flag),
            Form::Number(_) | Form::Power { .. } => number(),
            Form::Node => json!({ "type": "string" }),
            // `Parameter("name")` of a text parameter, and `Contents("name", "text")` of a file, are objects.
            Form::Text | Form::File | Form::SparseMatrix => json!({ "type": ["string", "object"] }),
            _ => json!({}),
        };
        (p.name.to_owned(), described(what, p.meaning))
    })
}

/// What a dynamic case takes for its solver.
fn solvers(defs: &mut Map<String, Value>) -> Option<&mut Vec<Value>> {
    let cases = defs.get_mut(&key(&schema::CASES))?.get_mut("anyOf")?.as_array_mut()?;
    let path = "/properties/Dynamic/anyOf/0/properties/solver/anyOf";
    cases.iter_mut().find_map(|case| case.pointer_mut(path))?.as_array_mut()
}

/// A function of time of another crate.
fn function(card: &Card) -> Value {
    let amplitude = described(number(), "Factor; its unit is that of the function.");
    custom(card, &[("amplitude".into(), amplitude)], &["amplitude"])
}

/// An output of another crate.
fn output(card: &Card) -> Value {
    let own: Vec<(String, Value)> = schema::DERIVED.iter().map(property).collect();
    custom(card, &own, &[schema::OF.name])
}

/// A solver of another crate.
fn solver(card: &Card) -> Value {
    custom(card, &[], &[])
}

/// What another crate offers: fields of its own, some of them needed, and those of its card.
fn custom(card: &Card, own: &[(String, Value)], needed: &[&str]) -> Value {
    let mut fields: Map<String, Value> = parameters(card).collect();
    fields.extend(own.iter().cloned());
    let of_card = card.parameters.iter().filter(|p| p.default == CardDefault::Required);
    let needed: Vec<&str> = needed.iter().copied().chain(of_card.map(|p| p.name)).collect();
    let fields = json!({
        "type": "object",
        "properties": fields,
        "required": needed,
        "additionalProperties": false,
    });
    named(card.kind, fields, card.summary)
}

fn element(card: &Card) -> Value {
    let mut fields = Map::new();
    let mut blocks = vec![&schema::PLACE, &schema::ELEMENT];
    if card.category == Category::Link {
        blocks.push(&schema::LINK);
    }
    if card.category == Category::Linear {
        blocks.push(&schema::MEMBER);
    }
    fields.extend(parameters(card));
    for block in blocks {
        // What has no place for a section says so where it is read.
        fields.extend(block.fields.iter().map(property));
    }
    let fields = json!({ "type": "object", "properties": fields, "additionalProperties": false });
    named(card.kind, fields, card.summary)
}
