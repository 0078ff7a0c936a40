//! Laws of one direction as uniaxial materials. What stands where was compared with OpenSees in the study `OP-1` of the
//! validation; numbers of Bouc and Wen are converted as `BoucWen` says.

use super::command::Word;
use super::members::{choice, flag, numbers};
use trilith_element::Values;
use trilith_model::Element;

/// A material without its tag.
#[derive(Clone, Debug)]
pub(super) struct Material {
    pub name: &'static str,
    pub words: Vec<Word>,
}

impl Material {
    fn new(name: &'static str, numbers: impl IntoIterator<Item = f64>) -> Self {
        Self { name, words: numbers.into_iter().map(Word::Real).collect() }
    }

    /// A spring with a dashpot beside it.
    pub fn elastic(k: f64, c: f64) -> Self {
        Self::new("Elastic", [k, c])
    }

    /// A spring in compression, behind a clearance.
    pub fn gap(k: f64, opening: f64) -> Self {
        if opening == 0.0 {
            return Self::new("ENT", [k]);
        }
        // It never yields: at a kilometre.
        Self::new("ElasticPPGap", [k, -1e3 * k, -opening])
    }

    /// A spring and a dashpot in compression, which may pull while closed.
    pub fn kelvin(k: f64, c: f64, opening: f64) -> Self {
        Self::new("ViscoelasticGap", [k, c, -opening])
    }
}

/// The materials of a law, side by side.
#[derive(Default)]
pub(super) struct Found {
    pub materials: Vec<Material>,
    /// Where the law differs.
    pub near: Option<&'static str>,
    /// What differs and changes nothing that matters.
    pub notes: Vec<(&'static str, &'static str)>,
}

impl From<Material> for Found {
    fn from(material: Material) -> Self {
        Self { materials: vec![material], ..Self::default() }
    }
}

/// The materials of the law of a link along one local axis, or why there are none.
pub(super) fn materials(e: &Element) -> Result<Found, String> {
    let v = &*e.values;
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    let opening = number("opening");
    Ok(match e.kind {
        "Gap" => {
            not_pressed(opening)?;
            Material::gap(number("k"), opening).into()
        }
        "Hook" => {
            not_pressed(opening)?;
            Material::new("ElasticPPGap", [number("k"), 1e3 * number("k"), opening]).into()
        }
        "ImpactKelvin" => {
            not_pressed(opening)?;
            let c = given(v, "damping")?;
            if !flag(v, "pull") || choice(v, "damps") == "Approach" {
                return Err("ViscoelasticGap damps all the time in contact, and pulls as it lets go (`pull: true`)".into());
            }
            Material::kelvin(number("k"), c, opening).into()
        }
        "ImpactHertz" => hertz(v)?,
        "Dashpot" => dashpot(v)?,
        "MaxwellDamper" => {
            Material::new("ViscousDamper", [number("k"), number("c"), number("exponent")]).into()
        }
        "BilinearDamper" => {
            let (c, cy) = (number("c"), number("cy"));
            Material::new("BilinearOilDamper", [number("k"), c, number("fl"), cy / c]).into()
        }
        "Wen" => {
            let (k, n, ratio) = (number("k"), number("exponent"), number("ratio"));
            if ratio >= 1.0 {
                return Ok(Material::elastic(k, 0.0).into());
            }
            let shape = 0.5 / (number("fy") / k).powf(n);
            bouc_wen([ratio, k, n, shape, shape, 1.0, 0.0, 0.0, 0.0])
        }
        "BoucWen" => {
            let (k, dy, n, alpha) = (number("k"), number("dy"), number("n"), number("alpha"));
            if alpha >= 1.0 {
                return Ok(Material::elastic(k, 0.0).into());
            }
            let per = dy.powf(n);
            let work = (1.0 - alpha) * k * dy * dy;
            let losses = ["delta_a", "delta_nu", "delta_eta"].map(|name| number(name) / work);
            let shape = [number("gamma") / per, number("beta") / per, number("a0")];
            let mut all = [alpha, k, n, shape[0], shape[1], shape[2], 0.0, 0.0, 0.0];
            all[6..].copy_from_slice(&losses);
            bouc_wen(all)
        }
        "MultilinearElastic" => {
            let (d, f) = (numbers(v.get("deformation")), numbers(v.get("force")));
            let mut material = Material::new("ElasticMultiLinear", [0.0]);
            material.words.push("-strain".into());
            material.words.extend(d.into_iter().map(Word::Real));
            material.words.push("-stress".into());
            material.words.extend(f.into_iter().map(Word::Real));
            material.into()
        }
        "MultilinearPlastic" => plastic(v)?,
        "IbarraMedinaKrawinkler" => capped(v),
        "SoilSpring" => soil(v)?,
        "FrequencyIndependentViscoelastic" => branches(v)?,
        "FrictionSpring" => {
            return Err("the branches of SelfCentering are parallel, those of ring springs run to one point".into());
        }
        _ => return Err("no law there is the same".into()),
    })
}

fn not_pressed(opening: f64) -> Result<(), String> {
    if opening < 0.0 {
        return Err(
            "a contact that is pressed at rest (`opening` below zero) has no counterpart".into()
        );
    }
    Ok(())
}

/// A number that may not come from a coefficient of restitution.
pub(super) fn given(v: &Values, name: &str) -> Result<f64, String> {
    v.number(name).ok_or_else(|| format!("its dashpot follows from `restitution`: give `{name}`"))
}

fn bouc_wen(numbers: [f64; 9]) -> Found {
    // Its own iterations end below what a comparison sees.
    let mut material = Material::new("BoucWen", numbers);
    material.words.extend([Word::Real(1e-10), Word::Whole(100)]);
    Found {
        materials: vec![material],
        near: None,
        notes: vec![("z", "steps of the first order there: it needs short ones")],
    }
}

fn hertz(v: &Values) -> Result<Found, String> {
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    not_pressed(number("opening"))?;
    let xi = given(v, "xi")?;
    let (k, gap, n) = (number("k"), -number("opening"), number("exponent"));
    if choice(v, "model") == "Jankowski" {
        let mass = given(v, "impact_mass")?;
        return Ok(Material::new("JankowskiImpact", [k, xi, mass, gap, n]).into());
    }
    Ok(Found {
        notes: vec![("speed", "the speed of an impact is that at the end of the step there")],
        ..Material::new("Hertzdamp", [k, xi, gap, n]).into()
    })
}

fn dashpot(v: &Values) -> Result<Found, String> {
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    let exponent = number("exponent");
    if choice(v, "when") == "InContact" {
        let c = given(v, "c")?;
        not_pressed(number("opening"))?;
        if !flag(v, "pull") || exponent != 1.0 {
            return Err(
                "a dashpot in contact there is linear and pulls as it lets go (`pull: true`)"
                    .into(),
            );
        }
        return Ok(Material::kelvin(number("stiffness"), c, number("opening")).into());
    }
    let c = v.number("c").or(v.number("cr")).unwrap_or(0.0);
    if exponent == 1.0 {
        return Ok(Material::elastic(0.0, c).into());
    }
    Ok(Found {
        notes: if exponent < 1.0 {
            vec![("rates below `linear_below`", "the power law holds there down to nothing")]
        } else {
            Vec::new()
        },
        ..Material::new("Viscous", [c, exponent]).into()
    })
}

/// Points of the side of positive forces where both sides are alike.
fn alike(v: &Values) -> Option<Vec<[f64; 2]>> {
    let (d, f) = (numbers(v.get("deformation")), numbers(v.get("force")));
    let up: Vec<[f64; 2]> =
        d.iter().zip(&f).map(|(d, f)| [*d, *f]).filter(|p| p[0] > 0.0).collect();
    let down: Vec<[f64; 2]> =
        d.iter().zip(&f).rev().map(|(d, f)| [-*d, -*f]).filter(|p| p[0] > 0.0).collect();
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs());
    let same = up.len() == down.len()
        && up.iter().zip(&down).all(|(a, b)| near(a[0], b[0]) && near(a[1], b[1]));
    (same && !up.is_empty()).then_some(up)
}

fn plastic(v: &Values) -> Result<Found, String> {
    let points = alike(v).ok_or("a curve whose sides differ has no counterpart")?;
    let rule = choice(v, "rule");
    match (rule, points.as_slice()) {
        ("Kinematic" | "Iwan" | "Isotropic", [[d, f]]) => Ok(Material::elastic(f / d, 0.0).into()),
        ("Kinematic" | "Iwan", _) => {
            Ok(Material::new("MultiLinear", points.iter().flatten().copied()).into())
        }
        ("Isotropic", [[d, f], [far, end]]) => {
            let (e, behind) = (f / d, (end - f) / (far - d));
            // Behind yield it is the spring and the plastic modulus in series.
            let modulus = e * behind / (e - behind);
            Ok(Material::new("Hardening", [e, *f, modulus, 0.0]).into())
        }
        _ => Err(format!("no law there has the rule `{rule}` for such a curve")),
    }
}

fn capped(v: &Values) -> Found {
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    let mut all = vec![number("k")];
    for side in ["", "_negative"] {
        let of = |name: &str| v.number(&format!("{name}{side}")).unwrap_or_else(|| number(name));
        // Nothing breaks off.
        let end = 1e3 * (of("plastic") + of("post_capping"));
        all.extend([
            of("plastic"),
            of("post_capping"),
            end,
            of("fy"),
            of("capping"),
            of("residual"),
        ]);
    }
    let worn = ["lambda_s", "lambda_c", "lambda_a", "lambda_k"].map(|name| v.number(name));
    // What never wears has an energy that nothing spends.
    all.extend(worn.map(|x| x.unwrap_or(1e12)));
    all.extend(["c_s", "c_c", "c_a", "c_k", "rate_positive", "rate_negative"].map(number));
    let name = if choice(v, "form") == "Pinching" {
        all.extend(["kappa_f", "kappa_d"].map(number));
        "IMKPinching"
    } else {
        "IMKPeakOriented"
    };
    let wears = worn.iter().any(Option::is_some);
    Found {
        near: wears.then_some("what wears out follows energies of trapezoids and reversals there"),
        ..Material::new(name, all).into()
    }
}

fn soil(v: &Values) -> Result<Found, String> {
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    if choice(v, "sides") != "Negative"
        || choice(v, "backbone") != "Hyperbolic"
        || number("drag") != 0.0
    {
        return Err(
            "HyperbolicGapMaterial is a hyperbola in compression alone, without drag".into()
        );
    }
    let k = number("k");
    let unloading = v.number("ku").unwrap_or(k);
    let (failure, pu) = (0.7, number("pu"));
    let numbers = [k, unloading, failure, -failure * pu, -number("opening")];
    Ok(Material::new("HyperbolicGapMaterial", numbers).into())
}

fn branches(v: &Values) -> Result<Found, String> {
    let (k, time) = (numbers(v.get("stiffness")), numbers(v.get("time")));
    if k.is_empty() || k.len() != time.len() {
        return Err(
            "give its branches (`stiffness`, `time`): they are Maxwell elements there".into()
        );
    }
    let mut found: Found = Material::elastic(v.number("k_inf").unwrap_or(0.0), 0.0).into();
    found.materials.extend(
        k.iter()
            .zip(&time)
            .filter(|(k, _)| **k > 0.0)
            .map(|(k, t)| Material::new("Maxwell", [*k, k * t, 1.0, 1.0])),
    );
    Ok(found)
}
