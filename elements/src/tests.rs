//! What holds for every kind: the card and the struct tell the same.

use trilith_element::{
    Card, Default, Form, ParameterError, ReadConstraint, ReadFunction, ReadLinear, ReadLink,
    ReadOutput, ReadSolver, Register, SparseMatrix, Value, Values,
};

/// Every card with a reader that forgets what it read.
struct Kinds(Vec<(&'static Card, Try)>);

type Try = Box<dyn Fn(&Values) -> Result<(), ParameterError>>;

impl Register for Kinds {
    fn add_linear(&mut self, card: &'static Card, read: ReadLinear) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
    fn add_constraint(&mut self, card: &'static Card, read: ReadConstraint) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
    fn add_link(&mut self, card: &'static Card, read: ReadLink) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
    fn add_function(&mut self, card: &'static Card, read: ReadFunction) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
    fn add_output(&mut self, card: &'static Card, read: ReadOutput) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
    fn add_solver(&mut self, card: &'static Card, read: ReadSolver) {
        self.0.push((card, Box::new(move |v| read(v).map(drop))));
    }
}

fn kinds() -> Kinds {
    let mut kinds = Kinds(Vec::new());
    crate::register(&mut kinds);
    kinds
}

/// A value of the right form for each parameter; choices take the `turn`-th of their names.
fn every_parameter(card: &Card, turn: usize) -> Vec<(String, Value)> {
    let one = |form: Form| match form {
        Form::Number(_) | Form::Power { .. } | Form::OfAxis { list: false, .. } => {
            Value::Number(0.5)
        }
        Form::OfAxis { .. } => Value::List(vec![Value::Number(1.0); 2]),
        Form::Choice(names) => Value::Text(names[turn % names.len()].into()),
        Form::Choices(names) => {
            Value::List(names.iter().map(|n| Value::Text((*n).into())).collect())
        }
        Form::Flag => Value::Flag(true),
        Form::Numbers { count, .. } => Value::List(vec![Value::Number(1.0); count.unwrap_or(2)]),
        Form::Matrix { size, .. } => {
            Value::List(vec![Value::List(vec![Value::Number(1.0); size]); size])
        }
        Form::Points => Value::List(vec![Value::List(vec![Value::Number(1.0); 3]); 3]),
        Form::Node | Form::Text => Value::Text("a".into()),
        Form::File => {
            let (name, text) = ("a.csv".into(), "0, 0\n1, 1\n".into());
            Value::File(std::sync::Arc::new(trilith_element::FileText { name, text }))
        }
        Form::SparseMatrix => {
            let entries = vec![(0, 0, 1.0)];
            let size = 1;
            Value::Matrix(std::sync::Arc::new(SparseMatrix {
                size,
                entries,
                ..SparseMatrix::default()
            }))
        }
        Form::Labels => Value::List(vec![Value::Text("a".into())]),
    };
    card.parameters.iter().map(|p| (p.name.to_owned(), one(p.form))).collect()
}

#[test]
fn every_parameter_and_choice_of_a_card_is_understood_by_its_kind() {
    for (card, read) in &kinds().0 {
        for turn in 0..6 {
            match read(&Values(every_parameter(card, turn))) {
                // Parameters that exclude each other are a matter of `check`, after reading, and what stands in a file is
                // none of the card's.
                Ok(()) | Err(ParameterError::Inconsistent { .. } | ParameterError::File { .. }) => {
                }
                Err(error) => panic!("{}: {error}", card.kind),
            }
        }
    }
}

#[test]
fn every_field_of_a_kind_is_on_its_card() {
    for (card, read) in &kinds().0 {
        let error = read(&Values(vec![("?".into(), Value::Flag(true))])).unwrap_err().to_string();
        let fields: Vec<_> = error.split('`').skip(3).step_by(2).collect();
        let names: Vec<_> = card.parameters.iter().map(|p| p.name).collect();
        assert_eq!(fields, names, "{}: {error}", card.kind);
    }
}

#[test]
fn kinds_and_their_parameters_have_names_of_their_own_and_admissible_defaults() {
    let kinds = kinds();
    for (i, (card, _)) in kinds.0.iter().enumerate() {
        assert!(kinds.0[..i].iter().all(|(c, _)| c.kind != card.kind), "{}", card.kind);
        assert!(card.example.contains(&format!("{}(", card.kind)), "{}", card.example);
        for (j, p) in card.parameters.iter().enumerate() {
            assert!(card.parameters[..j].iter().all(|q| q.name != p.name), "{}", p.name);
            match (p.default, p.form) {
                (Default::Number(x), _) => assert!(p.range.contains(x), "{}", p.name),
                (Default::Choice(c), Form::Choice(names)) => assert!(names.contains(&c)),
                (Default::Choice(_), Form::Text) => {}
                (Default::Choice(_), _) => panic!("{}: a choice without names", p.name),
                _ => {}
            }
        }
    }
}
