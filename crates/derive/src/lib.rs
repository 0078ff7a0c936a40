//! What a card says of parameters, from the struct that holds them.
//!
//! A kind states each of its parameters once, as a field: its documentation is the meaning, its type and
//! `#[parameter(…)]` are symbol, unit, range and default. `#[derive(Parameters)]` makes `PARAMETERS` of them, which
//! the card takes, with a table of them in its documentation; `#[derive(Choices)]` makes `NAMES` of the variants of an
//! enum that a parameter chooses from.
//!
//! Both are used by way of `trilith_element`, which documents them.

mod field;
mod table;
#[cfg(test)]
mod tests;
mod unit;

use field::Field;
use proc_macro2::TokenStream;
use quote::quote;
use syn::parse::ParseStream;
use syn::{Data, DeriveInput, Error, Fields, Path, Token, parse_macro_input, parse_quote};

/// `PARAMETERS`: the parameters of a card, from the fields of a struct. Documented at `trilith_element::Parameters`.
#[proc_macro_derive(Parameters, attributes(parameter, parameters))]
pub fn parameters(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    of_struct(&input).unwrap_or_else(Error::into_compile_error).into()
}

/// `NAMES`: the variants of an enum without data. Documented at `trilith_element::Choices`.
#[proc_macro_derive(Choices)]
pub fn choices(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    of_enum(&input).unwrap_or_else(Error::into_compile_error).into()
}

fn of_struct(input: &DeriveInput) -> syn::Result<TokenStream> {
    let wrong = "parameters are the named fields of a struct";
    let Data::Struct(data) = &input.data else { return Err(Error::new_spanned(input, wrong)) };
    let Fields::Named(fields) = &data.fields else { return Err(Error::new_spanned(input, wrong)) };
    let fields: Vec<Field> = fields
        .named
        .iter()
        .map(Field::read)
        .filter_map(Result::transpose)
        .collect::<syn::Result<_>>()?;
    let (name, table) = (&input.ident, table::of(&fields));
    let root = root(input)?;
    let parameters = fields.iter().map(|field| field.parameter(&root));
    let (implemented, generics, bounds) = input.generics.split_for_impl();
    Ok(quote! {
        #[automatically_derived]
        impl #implemented #name #generics #bounds {
            #[doc = #table]
            pub const PARAMETERS: &'static [#root::Parameter] = &[#(#parameters),*];
        }
    })
}

/// Where the contract is: `trilith_element`, or what `#[parameters(crate = trilith::element)]` says.
fn root(input: &DeriveInput) -> syn::Result<Path> {
    let Some(said) = input.attrs.iter().find(|a| a.path().is_ident("parameters")) else {
        return Ok(parse_quote!(::trilith_element));
    };
    said.parse_args_with(|tokens: ParseStream<'_>| {
        tokens.parse::<Token![crate]>()?;
        tokens.parse::<Token![=]>()?;
        tokens.parse()
    })
}

fn of_enum(input: &DeriveInput) -> syn::Result<TokenStream> {
    let wrong = "choices are the variants of an enum, without data";
    let Data::Enum(data) = &input.data else { return Err(Error::new_spanned(input, wrong)) };
    if let Some(variant) = data.variants.iter().find(|v| !matches!(v.fields, Fields::Unit)) {
        return Err(Error::new_spanned(variant, wrong));
    }
    let name = &input.ident;
    let names = data.variants.iter().map(|v| v.ident.to_string());
    Ok(quote! {
        #[automatically_derived]
        impl #name {
            /// The names of the choices, as model files have them.
            pub const NAMES: &'static [&'static str] = &[#(#names),*];
        }
    })
}
