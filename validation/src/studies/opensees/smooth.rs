//! Smooth hysteresis.

use super::pair::{Pair, command, material};
use super::paths::Wave::{self, Growing, Irregular};
use serde_json::{Value, json};

/// Parameters as OpenSees has them; the losses are per joule there.
#[derive(Clone, Copy)]
struct Numbers {
    alpha: f64,
    n: f64,
    gamma: f64,
    beta: f64,
    a0: f64,
    /// Of A, ν and η.
    losses: [f64; 3],
}

/// Stiffness at rest, N/m.
const K: f64 = 1e7;

impl Numbers {
    fn pair(self, name: &str, wave: Wave) -> Pair {
        let Self { alpha, n, gamma, beta, a0, losses: [a, nu, eta] } = self;
        let theirs = material("BoucWen", &[alpha, K, n, gamma, beta, a0, a, nu, eta]);
        self.beside(theirs, &format!("BoucWen, {name}"), wave)
    }

    /// Beside the material that can pinch, whose pinching is nought.
    fn unpinched(self, name: &str, wave: Wave) -> Pair {
        let Self { alpha, n, gamma, beta, a0, .. } = self;
        // Its own iterations end below what the comparison sees.
        let (q, zetas, p, shi, delta_shi, lambda, tolerance) =
            (0.1, 0.0, 1.0, 0.5, 0.1, 0.5, 1e-12);
        let numbers =
            [alpha, K, n, gamma, beta, a0, q, zetas, p, shi, delta_shi, lambda, tolerance];
        let mut theirs = command("uniaxialMaterial", "BWBN", &[1], &numbers);
        theirs.push(json!(100));
        self.beside(theirs.into(), &format!("BWBN, zetas = 0, {name}"), wave)
    }

    fn beside(self, theirs: Value, name: &str, wave: Wave) -> Pair {
        let Self { alpha, n, gamma, beta, a0, losses: [a, nu, eta] } = self;
        let joules = (1.0 - alpha) * K;
        let set = [
            ("axis", "U1".to_owned()),
            ("k", K.to_string()),
            ("dy", "1".to_owned()),
            ("alpha", alpha.to_string()),
            ("n", n.to_string()),
            ("beta", beta.to_string()),
            ("gamma", gamma.to_string()),
            ("a0", a0.to_string()),
            ("delta_a", (a * joules).to_string()),
            ("delta_nu", (nu * joules).to_string()),
            ("delta_eta", (eta * joules).to_string()),
        ];
        Pair::material(name, vec![theirs], vec![("BoucWen", set.to_vec())], wave).implicit()
    }
}

pub(super) fn pairs() -> Vec<Pair> {
    let (growing, irregular) = (Growing(0.03, 1.0), Irregular(0.03));
    let plain = Numbers { alpha: 0.1, n: 1.0, gamma: 30.0, beta: 70.0, a0: 1.0, losses: [0.0; 3] };
    let sharp = Numbers { alpha: 0.05, n: 2.0, gamma: 4e3, beta: 6e3, ..plain };
    let softer = Numbers { losses: [0.0, 0.0, 5e-5], ..plain };
    let weaker = Numbers { losses: [0.0, 5e-5, 0.0], ..plain };
    let all = Numbers { a0: 1.2, losses: [1e-5, 2e-5, 3e-5], ..plain };
    vec![
        plain.pair("n = 1, growing cycles", growing),
        plain.pair("n = 1, irregular", irregular),
        sharp.pair("n = 2, irregular", irregular),
        weaker.pair("loss of strength, growing cycles", growing),
        softer.pair("loss of stiffness, growing cycles", growing),
        all.pair("all losses, A₀ = 1.2, irregular", irregular),
        plain.unpinched("n = 1, growing cycles", growing),
        sharp.unpinched("n = 2, irregular", irregular),
    ]
}
