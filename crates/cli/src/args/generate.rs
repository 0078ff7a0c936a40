//! Arguments of `trilith generate`.

use super::values::{acceleration, length, pair, stress, time, whole};
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct GenerateArguments {
    #[command(subcommand)]
    pub what: Generated,
}

#[derive(Subcommand)]
pub(crate) enum Generated {
    /// A moment frame on sliding isolators under a synthetic ground motion
    Frame(FrameArguments),
}

#[derive(Args)]
pub(crate) struct FrameArguments {
    /// Start from a frame of about 1e2 … 1e5 degrees of freedom
    #[arg(long, value_parser = trilith::generate::Frame::PRESETS)]
    pub preset: Option<String>,
    /// Bays along X and Y, such as `5,4`
    #[arg(long, value_name = "X,Y", value_parser = pair(whole))]
    pub bays: Option<[usize; 2]>,
    /// Storeys above the base level
    #[arg(long)]
    pub storeys: Option<usize>,
    /// Elements that every member is cut into
    #[arg(long)]
    pub cuts: Option<usize>,
    /// Width of a bay, such as `6 m`
    #[arg(long, value_parser = length)]
    pub bay: Option<f64>,
    /// Height of a storey
    #[arg(long, value_parser = length)]
    pub storey: Option<f64>,
    /// Width and depth of the columns, such as `60 cm,60 cm`
    #[arg(long, value_name = "B,H", value_parser = pair(length))]
    pub column: Option<[f64; 2]>,
    /// Width and depth of the beams
    #[arg(long, value_name = "B,H", value_parser = pair(length))]
    pub beam: Option<[f64; 2]>,
    /// Width and depth of the beams of the base level
    #[arg(long, value_name = "B,H", value_parser = pair(length))]
    pub base_beam: Option<[f64; 2]>,
    /// Young's modulus, such as `30 GPa`
    #[arg(long, value_parser = stress)]
    pub young: Option<f64>,
    /// Friction coefficient of the isolators
    #[arg(long)]
    pub mu: Option<f64>,
    /// Radius of the pendulums of the isolators
    #[arg(long, value_parser = length)]
    pub radius: Option<f64>,
    /// Deformation at which the isolators slip, such as `1 mm`
    #[arg(long, value_parser = length)]
    pub uy: Option<f64>,
    /// Each of the two dampers as share of critical damping
    #[arg(long)]
    pub damper_ratio: Option<f64>,
    /// Largest ground acceleration along X and Y, such as `0.4 g,0.3 g`
    #[arg(long, value_name = "X,Y", value_parser = pair(acceleration))]
    pub peak: Option<[f64; 2]>,
    /// Step of the motion and of the analysis, in seconds
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Length of both, in seconds
    #[arg(long, value_parser = time)]
    pub duration: Option<f64>,
    /// Vectors of the FNA basis, from the ground motion alone [default: of the preset, or what the run chooses]
    #[arg(long)]
    pub vectors: Option<usize>,
    /// Model file to write [default: to the screen]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}
