//! One field of a struct as a parameter.

use crate::unit;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::parse::ParseStream;
use syn::punctuated::Punctuated;
use syn::token::Bracket;
use syn::{
    Attribute, Error, Expr, ExprLit, GenericArgument, Lit, LitStr, Meta, Path, PathArguments,
    Token, Type, bracketed,
};

/// A field with what `#[parameter(…)]` says of it.
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) meaning: String,
    pub(crate) symbol: String,
    pub(crate) shape: Shape,
    pub(crate) said: Said,
}

/// What the type of a field says.
pub(crate) enum Shape {
    Number,
    Flag,
    List,
    /// So many numbers.
    Array(TokenStream),
    Text,
    /// A list of anything else.
    Several,
    /// Anything else: `choices` or `form` say what.
    Other,
}

/// What stands in `#[parameter(…)]`, behind the symbol.
#[derive(Default)]
pub(crate) struct Said {
    /// Not to be given: the field is an `Option`, or serde has a default for it.
    pub(crate) optional: bool,
    pub(crate) unit: Option<LitStr>,
    /// The unit where the axis of a link is one of rotation.
    pub(crate) about: Option<LitStr>,
    /// For a unit that is raised to a power: which, and the parameter that holds the exponent.
    pub(crate) per: Option<LitStr>,
    exponent: Option<LitStr>,
    pub(crate) range: Option<Expr>,
    pub(crate) default: Option<Expr>,
    pub(crate) choices: Option<Choices>,
    form: Option<Expr>,
}

/// Names to choose from.
pub(crate) enum Choices {
    /// `["U1", "U2"]`.
    Listed(Vec<LitStr>),
    /// A constant that holds them, such as `Axis::NAMES`.
    Of(Path),
}

impl Field {
    /// A field, unless it is no parameter (`#[serde(skip)]`).
    pub(crate) fn read(field: &syn::Field) -> syn::Result<Option<Self>> {
        let ident = field.ident.as_ref().expect("fields are named");
        let Some(attribute) = field.attrs.iter().find(|a| a.path().is_ident("parameter")) else {
            return if serde_says(&field.attrs, "skip") { Ok(None) } else { Err(unsaid(field)) };
        };
        let inner = within_option(&field.ty);
        let shape = shape(inner.unwrap_or(&field.ty));
        let flag = matches!(shape, Shape::Flag);
        let optional = inner.is_some() || (!flag && serde_says(&field.attrs, "default"));
        let (symbol, said) = match &attribute.meta {
            Meta::Path(_) => Default::default(),
            _ => attribute.parse_args_with(|input: ParseStream<'_>| said(input))?,
        };
        let meaning = documentation(&field.attrs);
        if meaning.is_empty() {
            let message = "a parameter says what it means: document the field";
            return Err(Error::new_spanned(field, message));
        }
        let name = ident.to_string();
        let read = Self { name, meaning, symbol, shape, said: Said { optional, ..said } };
        read.check(field)?;
        Ok(Some(read))
    }

    /// The parameter that a card has of it.
    pub(crate) fn parameter(&self, root: &Path) -> TokenStream {
        let Self { name, symbol, meaning, said, .. } = self;
        let (form, default) = (self.form(root), self.default(root));
        let range = said.range.as_ref().map(|r| quote! { .within(#root::Range::#r) });
        quote! {
            #root::Parameter::new(#name, #symbol, #form, #default, #meaning) #range
        }
    }

    fn form(&self, root: &Path) -> TokenStream {
        let said = &self.said;
        if let Some(form) = &said.form {
            return quote! { #root::Form::#form };
        }
        if let Some(choices) = &said.choices {
            let names = match choices {
                Choices::Listed(names) => quote! { &[#(#names),*] },
                Choices::Of(path) => path.to_token_stream(),
            };
            return match self.shape {
                Shape::Several => quote! { #root::Form::Choices(#names) },
                _ => quote! { #root::Form::Choice(#names) },
            };
        }
        match self.shape {
            Shape::Flag => return quote! { #root::Form::Flag },
            Shape::Text => return quote! { #root::Form::Text },
            _ => {}
        }
        let list = matches!(self.shape, Shape::List);
        let unit = dimension(said.unit.as_ref(), root);
        if let Some(about) = &said.about {
            let about = dimension(Some(about), root);
            return quote! { #root::Form::OfAxis { along: #unit, about: #about, list: #list } };
        }
        if let Some((per, exponent)) = said.per.as_ref().zip(said.exponent.as_ref()) {
            let over = dimension(Some(per), root);
            return quote! { #root::Form::Power { base: #unit, over: #over, exponent: #exponent } };
        }
        let count = match &self.shape {
            Shape::List => quote! { ::core::option::Option::None },
            Shape::Array(n) => quote! { ::core::option::Option::Some(#n) },
            _ => return quote! { #root::Form::Number(#unit) },
        };
        quote! { #root::Form::Numbers { dimension: #unit, count: #count } }
    }

    fn default(&self, root: &Path) -> TokenStream {
        match &self.said.default {
            Some(Expr::Lit(ExprLit { lit: Lit::Str(text), .. })) => {
                quote! { #root::Default::Choice(#text) }
            }
            Some(Expr::Lit(ExprLit { lit: Lit::Bool(flag), .. })) => {
                quote! { #root::Default::Flag(#flag) }
            }
            Some(number) => quote! { #root::Default::Number(#number) },
            None if self.said.optional => quote! { #root::Default::Absent },
            None if matches!(self.shape, Shape::Flag) => {
                quote! { #root::Default::Flag(false) }
            }
            None => quote! { #root::Default::Required },
        }
    }

    /// Refuses what would be a parameter that nobody meant.
    fn check(&self, field: &syn::Field) -> syn::Result<()> {
        let said = &self.said;
        let refuse = |message: &str| Err(Error::new_spanned(field, message));
        let named = matches!(self.shape, Shape::Several | Shape::Other);
        let wordy = matches!(self.shape, Shape::Flag | Shape::Text);
        let numbers = !named && !wordy && said.form.is_none();
        match (numbers, &said.unit) {
            (true, None) => return refuse("a number has a unit: `unit = \"N/m\"`, or `\"1\"`"),
            (false, Some(_)) => return refuse("only numbers have a unit"),
            _ => {}
        }
        if named && said.form.is_none() && said.choices.is_none() {
            return refuse("this type needs `choices = …` or `form = …`");
        }
        if said.per.is_some() != said.exponent.is_some() {
            return refuse("`per` and `exponent` belong together: unit/perᵉ");
        }
        if within_option(&field.ty).is_some() && said.default.is_some() {
            return refuse(
                "an `Option` is absent where the file says nothing: it has no `default`",
            );
        }
        for unit in [&said.unit, &said.about, &said.per].into_iter().flatten() {
            unit::parse(&unit.value()).map_err(|message| Error::new_spanned(unit, message))?;
        }
        Ok(())
    }
}

/// Symbol first, then `key = value`.
fn said(input: ParseStream<'_>) -> syn::Result<(String, Said)> {
    let mut said = Said::default();
    let symbol = if input.peek(LitStr) { input.parse::<LitStr>()?.value() } else { String::new() };
    if !symbol.is_empty() && !input.is_empty() {
        input.parse::<Token![,]>()?;
    }
    while !input.is_empty() {
        let key: syn::Ident = input.parse()?;
        input.parse::<Token![=]>()?;
        match key.to_string().as_str() {
            "unit" => said.unit = Some(input.parse()?),
            "about" => said.about = Some(input.parse()?),
            "per" => said.per = Some(input.parse()?),
            "exponent" => said.exponent = Some(input.parse()?),
            "range" => said.range = Some(input.parse()?),
            "default" => said.default = Some(input.parse()?),
            "choices" => said.choices = Some(names(input)?),
            "form" => said.form = Some(input.parse()?),
            _ => {
                let message =
                    "known are unit, about, per, exponent, range, default, choices and form";
                return Err(Error::new_spanned(key, message));
            }
        }
        if !input.is_empty() {
            input.parse::<Token![,]>()?;
        }
    }
    Ok((symbol, said))
}

fn names(input: ParseStream<'_>) -> syn::Result<Choices> {
    if !input.peek(Bracket) {
        return input.parse().map(Choices::Of);
    }
    let list;
    bracketed!(list in input);
    let names = Punctuated::<LitStr, Token![,]>::parse_terminated(&list)?;
    Ok(Choices::Listed(names.into_iter().collect()))
}

/// What a type says; of an `Option`, the type in it.
fn shape(ty: &Type) -> Shape {
    match ty {
        Type::Array(array) if is(&array.elem, "f64") => Shape::Array(array.len.to_token_stream()),
        _ if is(ty, "Vector3") => Shape::Array(quote! { 3 }),
        _ if is(ty, "Vec<f64>") => Shape::List,
        _ if is(ty, "f64") => Shape::Number,
        _ if is(ty, "bool") => Shape::Flag,
        _ if is(ty, "String") => Shape::Text,
        Type::Path(path) if path.path.segments.last().is_some_and(|s| s.ident == "Vec") => {
            Shape::Several
        }
        _ => Shape::Other,
    }
}

fn is(ty: &Type, text: &str) -> bool {
    ty.to_token_stream().to_string().replace(' ', "") == text
}

/// The type in an `Option`.
fn within_option(ty: &Type) -> Option<&Type> {
    let Type::Path(path) = ty else { return None };
    let last = path.path.segments.last().filter(|last| last.ident == "Option")?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else { return None };
    match arguments.args.first() {
        Some(GenericArgument::Type(ty)) => Some(ty),
        _ => None,
    }
}

/// The documentation of a field in one line.
fn documentation(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|a| a.path().is_ident("doc")).filter_map(|a| {
        let Meta::NameValue(pair) = &a.meta else { return None };
        let Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) = &pair.value else { return None };
        Some(text.value().trim().to_owned())
    });
    lines.collect::<Vec<_>>().join(" ")
}

fn serde_says(attributes: &[Attribute], word: &str) -> bool {
    let serde = attributes.iter().filter(|a| a.path().is_ident("serde"));
    serde.filter_map(|a| a.meta.require_list().ok()).any(|list| list.tokens.to_string() == word)
}

fn unsaid(field: &syn::Field) -> Error {
    let message =
        "a field is a parameter: say `#[parameter(…)]`, or `#[serde(skip)]` where it is none";
    Error::new_spanned(field, message)
}

fn dimension(unit: Option<&LitStr>, root: &Path) -> TokenStream {
    let exponents = unit.and_then(|u| unit::parse(&u.value()).ok()).unwrap_or_default();
    let [mass, length, time] = exponents.map(f64::from);
    quote! { #root::Dimension { mass: #mass, length: #length, time: #time } }
}
