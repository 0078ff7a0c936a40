//! Arguments of `trilith record`.

use crate::Failure;
use clap::Args;
use std::path::PathBuf;
use trilith::element::Dimension;
use trilith::element::dimension::{ACCELERATION, FREQUENCY, TIME};
use trilith::model::quantity;
use trilith::record::process::{Baseline, Filter, Padding, Processing, Resampling};
use trilith::record::{Component, Format, ReadOptions, acceleration_unit};

#[derive(Args)]
pub(crate) struct Arguments {
    /// Records: AT2, COSMOS, CSMIP, K-NET, ESM, or columns of numbers; the format is found from the content
    #[arg(required_unless_present = "synthetic")]
    pub files: Vec<PathBuf>,
    /// Component of files with several, by name or by number from 1 [default: all]
    #[arg(long, value_name = "NAME", value_parser = component)]
    pub component: Option<Component>,
    /// Format, where the content leaves it open
    #[arg(long, value_parser = format)]
    pub format: Option<Format>,
    /// Unit of the values where the file does not state it, such as `g` or `cm/s^2`
    #[arg(long, value_parser = unit)]
    pub unit: Option<f64>,
    /// Time step where the file does not state it, such as `5 ms`; of a synthetic motion [default there: 10 ms]
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Keep a part, such as `1 s,20 s`
    #[arg(long, value_name = "FROM,TO", value_parser = crate::args::pair(moment))]
    pub trim: Option<[f64; 2]>,
    /// Take a baseline away: mean, linear, the order of a polynomial, or rest (velocity and displacement then end
    /// at zero)
    #[arg(long, value_parser = baseline)]
    pub baseline: Option<Baseline>,
    /// Share of the duration over which each end rises and falls with a half cosine
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub taper: f64,
    /// Corner of a Butterworth high-pass, such as `0.1 Hz`
    #[arg(long, value_name = "F", value_parser = frequency)]
    pub highpass: Option<f64>,
    /// Corner of a Butterworth low-pass
    #[arg(long, value_name = "F", value_parser = frequency)]
    pub lowpass: Option<f64>,
    /// Order of the filter
    #[arg(long, default_value_t = 4)]
    pub order: usize,
    /// Filter once forward instead of forward and back
    #[arg(long)]
    pub causal: bool,
    /// Zeros around the record that a high-pass needs: none, strip or keep
    #[arg(long, default_value = "strip", value_parser = padding)]
    pub pad: Padding,
    /// New time step, band-limited
    #[arg(long, value_name = "DT", value_parser = time)]
    pub resample: Option<f64>,
    /// Scale to this peak, such as `0.3 g`
    #[arg(long, value_name = "PEAK", value_parser = acceleration)]
    pub scale_to: Option<f64>,
    /// Scale by a factor
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    pub scale: Option<f64>,
    /// Damping ratios of the spectra
    #[arg(long, value_delimiter = ',', default_value = "0.05", value_parser = damping)]
    pub damping: Vec<f64>,
    /// Periods of the printed spectra, s
    #[arg(long, value_delimiter = ',', default_value = "0.1,0.2,0.3,0.5,1,2,4", value_parser = seconds)]
    pub periods: Vec<f64>,
    /// Make a motion of filtered white noise (Kanai–Tajimi) with this seed
    #[arg(long, value_name = "SEED", conflicts_with = "files")]
    pub synthetic: Option<u64>,
    /// Target spectrum that the synthetic motion meets: a file with the columns period and pseudo-acceleration
    #[arg(long, value_name = "FILE", requires = "synthetic", conflicts_with = "peak")]
    pub spectrum: Option<PathBuf>,
    /// Peak of the synthetic motion [default: 0.3 g]
    #[arg(long, requires = "synthetic", value_parser = acceleration)]
    pub peak: Option<f64>,
    /// Length of the synthetic motion [default: 20 s]
    #[arg(long, requires = "synthetic", value_parser = time)]
    pub duration: Option<f64>,
    /// Frequency of the ground of the synthetic motion [default: 2.5 Hz]
    #[arg(long, value_name = "F", requires = "synthetic", value_parser = frequency)]
    pub ground_frequency: Option<f64>,
    /// Damping of the ground of the synthetic motion [default: 0.6]
    #[arg(long, value_name = "RATIO", requires = "synthetic")]
    pub ground_damping: Option<f64>,
    /// Folder for `record.html`, `spectra.csv` and the processed records as CSV files that models can read
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl Arguments {
    pub fn reading(&self) -> ReadOptions {
        ReadOptions { format: self.format, unit: self.unit, dt: self.dt }
    }

    pub fn processing(&self) -> Result<Processing, Failure> {
        let filter = (self.highpass.is_some() || self.lowpass.is_some()).then_some(Filter {
            highpass: self.highpass,
            lowpass: self.lowpass,
            order: self.order,
            causal: self.causal,
            padding: self.pad,
        });
        if self.scale.is_some_and(|s| !s.is_finite()) {
            return Err(Failure::input("`--scale` must be a finite number", None));
        }
        Ok(Processing {
            trim: self.trim.map(|[from, to]| (from, to)),
            baseline: self.baseline,
            taper: self.taper,
            filter,
            resample: self.resample.map(|dt| (dt, Resampling::BandLimited)),
            scale_to: self.scale_to,
            scale: self.scale,
        })
    }
}

fn component(text: &str) -> Result<Component, String> {
    Ok(match text.parse() {
        Ok(n) if n < 100 => Component::Number(n),
        _ => Component::Name(text.to_owned()),
    })
}

fn format(text: &str) -> Result<Format, String> {
    Format::ALL.into_iter().find(|f| f.name().eq_ignore_ascii_case(text)).ok_or_else(|| {
        crate::text::names_help(text, "formats", Format::ALL.iter().map(|f| f.name()))
    })
}

fn unit(text: &str) -> Result<f64, String> {
    match acceleration_unit(text) {
        Some(unit) => Ok(unit),
        None => above_zero(text, ACCELERATION)
            .or_else(|_| above_zero(&format!("1 {text}"), ACCELERATION))
            .map_err(|_| "a unit such as `g`, `cm/s^2` or `1e-6 g` is wanted".into()),
    }
}

fn above_zero(text: &str, dimension: Dimension) -> Result<f64, String> {
    match quantity(text, dimension)? {
        x if x > 0.0 => Ok(x),
        _ => Err(format!("a value above 0 in {} is wanted", dimension.unit())),
    }
}

fn time(text: &str) -> Result<f64, String> {
    above_zero(text, TIME)
}

fn moment(text: &str) -> Result<f64, String> {
    quantity(text, TIME)
}

fn frequency(text: &str) -> Result<f64, String> {
    above_zero(text, FREQUENCY)
}

fn acceleration(text: &str) -> Result<f64, String> {
    above_zero(text, ACCELERATION)
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(t) if t.is_finite() && t >= 0.0 => Ok(t),
        _ => Err("periods in seconds are wanted, such as `0.2,0.5,1`".into()),
    }
}

fn damping(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(z) if (0.0..=0.9).contains(&z) => Ok(z),
        _ => Err("a share of critical between 0 and 0.9 is wanted, such as `0.05`".into()),
    }
}

fn baseline(text: &str) -> Result<Baseline, String> {
    match (text, text.parse()) {
        ("mean", _) => Ok(Baseline::Mean),
        ("linear", _) => Ok(Baseline::Linear),
        ("rest", _) => Ok(Baseline::Rest),
        (_, Ok(order)) if order <= 20 => Ok(Baseline::Polynomial(order)),
        _ => Err("`mean`, `linear`, `rest` or an order up to 20 is wanted".into()),
    }
}

fn padding(text: &str) -> Result<Padding, String> {
    match text {
        "none" => Ok(Padding::None),
        "strip" => Ok(Padding::Strip),
        "keep" => Ok(Padding::Keep),
        _ => Err("`none`, `strip` or `keep` is wanted".into()),
    }
}
