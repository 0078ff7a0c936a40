//! Numbers as a model file would have them.

use trilith::element::Dimension;

/// A number in SI with its unit, read back to the same bits.
pub(crate) fn written(x: f64, dimension: Dimension) -> String {
    if dimension.is_none() { format!("{x:?}") } else { format!("{x:?} {}", dimension.unit()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith::element::dimension as d;

    #[test]
    fn numbers_come_back_to_the_bit_in_every_unit() {
        let odd = Dimension { mass: 1.0, length: 0.5, time: -1.5 };
        for dimension in [d::LENGTH, d::STIFFNESS, d::ROTATIONAL_DAMPING, d::AREA, d::NONE, odd] {
            for x in [0.1 + 0.2, -1e300, 3e-310, 1e21, 2.0] {
                let text = written(x, dimension);
                let back = trilith::model::quantity(&text, dimension);
                assert_eq!(back.map(f64::to_bits), Ok(x.to_bits()), "{text}");
            }
        }
    }
}
