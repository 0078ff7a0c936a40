//! `trilith calibrate`: dashpots from coefficients of restitution.

use crate::args::{CalibrateArguments, Kept};
use crate::text::{exact, number, percent, row, significant, table};
use crate::{Answer, Failure, diagnostics, read};
use trilith::calibrate::{Calibrator, Drop, Horizontal, Swing};
use trilith::model::{Plane, visible_line};
use trilith::{Error, Model, Registry};

/// Rocking that differs by more than this from rigid theory gets a remark.
const FAR: f64 = 0.02;

pub(crate) fn calibrate(registry: &Registry, args: &CalibrateArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let horizontal = horizontal(&model, args.along.as_deref())?;
    let head = format!("{}\n\n", visible_line(&model.title));
    // The model goes into the calibrator, its text stays for messages.
    let places = model.places.clone();
    let refuse = |e: Error| match e.span() {
        Some(span) => {
            Failure { text: diagnostics::at(&e.to_string(), &places.find(&span)), status: 2 }
        }
        None => Failure::input(&e.to_string(), None),
    };
    let mut it = Calibrator::new(model, horizontal).map_err(refuse)?;
    let mut out = head + &body(&it);
    if it.body().flat {
        out += &vertical(&mut it, args).map_err(refuse)?;
    }
    if it.theory().is_ok() || args.rocking.is_some() {
        out += &rocking(&mut it, args).map_err(refuse)?;
    }
    Ok(out.into())
}

fn horizontal(model: &Model, asked: Option<&str>) -> Result<Horizontal, Failure> {
    let of_model = match model.plane {
        Some(Plane::XZ) => Some(Horizontal::X),
        Some(Plane::YZ) => Some(Horizontal::Y),
        Some(Plane::XY) => {
            let help = "gravity acts along −Z: use `plane: XZ` or `plane: YZ`";
            return Err(Failure::input("a model in the plane XY cannot stand on feet", Some(help)));
        }
        None => None,
    };
    let asked =
        asked.map(|a| if a.eq_ignore_ascii_case("Y") { Horizontal::Y } else { Horizontal::X });
    match (of_model, asked) {
        (Some(m), Some(a)) if m != a => {
            let message = format!("the plane of the model leaves no motion along {}", a.name());
            Err(Failure::input(&message, Some("leave `--along` out")))
        }
        (m, a) => Ok(a.or(m).unwrap_or(Horizontal::X)),
    }
}

fn body(it: &Calibrator) -> String {
    let b = it.body();
    let along = b.horizontal.name();
    let mut out = format!(
        "body: {} kg, centre of gravity {along} = {} m, Z = {} m, moment of inertia about it {} kg·m²\n\n",
        number(b.mass),
        number(b.x),
        number(b.z),
        number(b.inertia)
    );
    let mut rows = vec![row([
        "foot",
        &format!("{along} [m]"),
        "stiffness [N/m]",
        "dashpot [N·s/m]",
        "mass in a flat drop [kg]",
        "alone [kg]",
    ])];
    for f in &b.feet {
        let cells = [f.x, f.stiffness, f.damping, f.mass, f.alone].map(number);
        rows.push(std::iter::once(f.name.clone()).chain(cells).collect());
    }
    out += &table(&rows, &[0]);
    out
}

fn measured(drop: &Drop) -> String {
    format!(
        "{} ({} rebound from {} m)",
        significant(drop.restitution(), 4),
        percent(drop.rebound / drop.height),
        number(drop.height)
    )
}

fn vertical(it: &mut Calibrator, args: &CalibrateArguments) -> Result<String, Error> {
    let mut out = String::from("\nflat drop\n");
    let Some(e) = args.restitution else {
        let drop = it.drop(args.height)?;
        return Ok(
            out + &format!("  restitution with the dashpots of the model  {}\n", measured(&drop))
        );
    };
    // Tuned first, so that rocking below runs on the dashpots that the file would have.
    let tuned = it.tune_drop(e, args.height);
    let dashpots = it.set_restitution(e)?;
    let drop = it.drop(args.height)?;
    out += &format!("  wanted restitution             {}\n", exact(e));
    out += &format!("  dashpots in closed form        {}\n", list(&dashpots));
    out += &format!("  restitution of a drop          {}\n", measured(&drop));
    match tuned {
        Ok((dashpots, drop)) => {
            out += &format!("  dashpots tuned to this drop    {}\n", list(&dashpots));
            out += &format!("  restitution of the drop then   {}\n", measured(&drop));
        }
        Err(e) => out += &format!("  tuned to this drop: {e}\n"),
    }
    out += &format!(
        "  in the model: `restitution: {}` in place of the dashpot, for the closed form\n",
        exact(e)
    );
    Ok(out)
}

fn list(dashpots: &[f64]) -> String {
    let same = dashpots.windows(2).all(|w| (w[0] - w[1]).abs() < 1e-9 * w[0].abs());
    let text = |c: &f64| significant(*c, 6);
    match (same, dashpots.first()) {
        (true, Some(c)) => format!("{} N·s/m at each foot", text(c)),
        _ => format!("{} N·s/m", dashpots.iter().map(text).collect::<Vec<_>>().join(", ")),
    }
}

fn rocking(it: &mut Calibrator, args: &CalibrateArguments) -> Result<String, Error> {
    let theory = it.theory()?;
    let uplift = args.uplift.unwrap_or(0.1 * theory.balance * theory.width);
    let tilt = (uplift / theory.width) / theory.balance;
    let swing = |s: &Swing| {
        format!("{} ({} m after {} m)", ratio(s.ratio()), number(s.after), number(s.before))
    };
    let free = it.rocking(uplift, 0.0)?;
    let mut out =
        format!("\nrocking from an uplift of {} m, {} of balance\n", number(uplift), percent(tilt));
    out += &format!("  kept by a swing, rigid theory (Housner)   {}\n", ratio(theory.uplift));
    out += &format!("  without rotational dashpot                {}\n", swing(&free));
    let off = free.ratio() / theory.uplift - 1.0;
    if off.abs() > FAR {
        out += &format!(
            "  {} off: the struck corner bounces and throws the base sideways; with pre-slip stiffness\n  \
             ks = 30 kn and friction that holds, stiff contacts come to rigid theory by themselves\n",
            percent(off)
        );
    }
    if tilt > 0.1 + 1e-9 {
        out +=
            "  beyond a tenth of balance small rotations leave out that the weight's arm shrinks\n";
    }
    let wanted = match args.rocking {
        None => return Ok(out),
        Some(Kept::Housner) => theory.uplift,
        Some(Kept::Share(x)) => x,
    };
    let (dashpot, tuned) = it.tune_rocking(wanted, uplift)?;
    out += &format!("  wanted                                    {}\n", ratio(wanted));
    out += &format!(
        "  with a rotational dashpot of {} N·m·s  {}\n",
        significant(dashpot, 5),
        swing(&tuned)
    );
    if let Some(node) = it.dashpot_node() {
        let axis = if it.body().horizontal == Horizontal::X { "cr3" } else { "cr2" };
        out += &format!(
            "  in the model: \"rocking dashpot\": Spring(node: \"{}\", {axis}: \"{} N*m*s\")\n  \
             (right at this uplift; it takes less from smaller ones)\n",
            visible_line(node),
            significant(dashpot, 5)
        );
    }
    Ok(out)
}

fn ratio(x: f64) -> String {
    significant(x, 4)
}
