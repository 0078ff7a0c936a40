//! A kind of link that is made at run time.

use crate::called::CalledLaw;
use crate::card::{Shape, shape};
use crate::declaration::Declaration;
use crate::error::DeclarationError;
use crate::function::{LawFunction, Sizes};
use std::sync::Arc;
use trilith_element::{Card, Link, ParameterError, ReadLink, Register, Values};

/// A kind: what a law says of itself, and what answers for it.
#[derive(Clone, Debug)]
pub struct Kind {
    shape: &'static Shape,
    function: Arc<dyn LawFunction>,
}

impl Kind {
    /// Of a declaration, with a function that answers for laws of it.
    ///
    /// # Errors
    /// [`DeclarationError`] where it cannot be the declaration of a law.
    pub fn new(
        declaration: &Declaration,
        function: Arc<dyn LawFunction>,
    ) -> Result<Self, DeclarationError> {
        Ok(Self { shape: shape(declaration)?, function })
    }

    /// Its card.
    #[must_use]
    pub fn card(&self) -> &'static Card {
        &self.shape.card
    }

    /// Lengths of the lists that its function sees.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        self.shape.sizes
    }

    /// Whether its law says what it stores and turns to heat.
    #[must_use]
    pub fn accounts(&self) -> bool {
        self.shape.energy
    }

    /// Whether its law gives its tangents.
    #[must_use]
    pub fn has_tangent(&self) -> bool {
        self.shape.tangent
    }

    /// Offers it to an application.
    pub fn register(&self, to: &mut impl Register) {
        to.add_link(&self.shape.card, self.reader());
    }

    fn reader(&self) -> ReadLink {
        let Self { shape, function } = self.clone();
        Arc::new(move |values: &Values| {
            let number = |p: &trilith_element::Parameter| {
                let wanted =
                    || ParameterError::Form { message: format!("`{}` is no number", p.name) };
                values.number(p.name).ok_or_else(wanted)
            };
            let parameters = shape.card.parameters.iter().map(number);
            let parameters: Box<[f64]> = parameters.collect::<Result<_, _>>()?;
            let law = CalledLaw::new(shape, Arc::clone(&function), parameters)
                .map_err(|message| ParameterError::Form { message })?;
            Ok(Box::new(law) as Box<dyn Link>)
        })
    }
}
