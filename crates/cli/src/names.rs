//! Names of a model as arguments: lists of them, and those that hold commas.

use crate::text::names_help;

/// Names that one option lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Names(Vec<String>);

/// The names of all options of a kind, in their order.
pub(crate) fn flat(lists: &[Names]) -> Vec<String> {
    lists.iter().flat_map(|list| list.0.iter().cloned()).collect()
}

/// Reads a list with commas between its names. Double quotes hold a name with commas together; inside them, two stand
/// for one.
pub(crate) fn list(text: &str) -> Result<Names, String> {
    let (mut names, mut name) = (Vec::new(), String::new());
    // In quotes, and: the name began with them.
    let (mut inside, mut quoted) = (false, false);
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if inside && characters.peek() == Some(&'"') => {
                characters.next();
                name.push('"');
            }
            '"' if inside => inside = false,
            '"' if name.is_empty() && !quoted => (inside, quoted) = (true, true),
            ',' if !inside => {
                names.push(std::mem::take(&mut name));
                quoted = false;
            }
            _ if quoted && !inside => {
                return Err(format!("a comma is wanted behind the name in quotes, not `{c}`"));
            }
            c => name.push(c),
        }
    }
    if inside {
        return Err("the quotes of a name do not end".into());
    }
    names.push(name);
    Ok(Names(names))
}

/// Expressions with commas between them, those in parentheses and in quotes left out.
pub(crate) fn parts(lists: &[String]) -> Vec<String> {
    let mut all = Vec::new();
    for list in lists {
        let (mut part, mut depth, mut quoted) = (String::new(), 0_usize, false);
        for c in list.chars() {
            match c {
                '"' => quoted = !quoted,
                '(' if !quoted => depth += 1,
                ')' if !quoted => depth = depth.saturating_sub(1),
                ',' if !quoted && depth == 0 => {
                    all.push(std::mem::take(&mut part));
                    continue;
                }
                _ => {}
            }
            part.push(c);
        }
        all.push(part);
    }
    all
}

/// What there is instead of a name, and how a name with a comma is given to an option.
pub(crate) fn help<'a>(
    name: &str,
    what: &str,
    option: &str,
    mut candidates: impl Iterator<Item = &'a str> + Clone,
) -> String {
    let told = names_help(name, what, candidates.clone());
    match candidates.find(|c| c.contains(',')) {
        None => told,
        Some(c) => {
            let c = c.replace('"', "\"\"");
            format!("{told}; a name with a comma stands in double quotes: `{option} '\"{c}\"'`")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<String> {
        list(text).unwrap().0
    }

    #[test]
    fn commas_separate_names_and_quotes_hold_them_together() {
        assert_eq!(read("a,foot left"), ["a", "foot left"]);
        assert_eq!(read("\"a, b\",c"), ["a, b", "c"]);
        assert_eq!(read("\"say \"\"so\"\", b\""), ["say \"so\", b"]);
        // Within a name quotes are letters as others.
        assert_eq!(read("3\" pipe,b"), ["3\" pipe", "b"]);
        assert_eq!(flat(&[list("a,b").unwrap(), list("c").unwrap()]), ["a", "b", "c"]);
    }

    #[test]
    fn commas_within_expressions_stay() {
        let all = parts(&["max(a, b), \"c, d\"".into(), "e".into()]);
        assert_eq!(all, ["max(a, b)", " \"c, d\"", "e"]);
    }

    #[test]
    fn quotes_that_do_not_end_are_told() {
        assert!(list("\"a, b").unwrap_err().contains("do not end"));
        assert!(list("\"a\"b,c").unwrap_err().contains("comma"));
    }
}
