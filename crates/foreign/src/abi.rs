//! The contract in C, from this side: tables as `trilith_link.h` has them, and calls through pointers.
//!
//! All that is unsafe of this crate is here. What it rests on:
//!
//! - A library that exports `trilith_law_at` means what the header says by it: pointers lead to as much as the counts say, texts
//!   end in zero, functions have the signatures of the header and do not unwind. Nothing can check this; a table with
//!   another number of the contract, or without what must be there, is refused before anything else of it is read.
//! - Lists that are handed over have the lengths that the table declares: [`Address::call`] checks them in every call.
//! - Code and tables live as long as the library is open: every function holds what it comes from.
#![allow(unsafe_code)]

use crate::declaration::{
    Declaration, DeclaredField, DeclaredParameter, DeclaredRange, DeclaredValue,
};
use crate::function::{LawFunction, NoAnswer, Sizes};
use dlopen2::raw;
use std::any::Any;
use std::ffi::{CStr, c_char};
use std::fmt;
use std::sync::Arc;
use trilith_element::{Kinematics, Response};

const ABI: u32 = 1;
const RATES: u32 = 1;
const TANGENT: u32 = 2;
const ENERGY: u32 = 4;
/// More of anything is no table.
const MOST: usize = 1000;

/// A law by its address, `trilith_respond` of the header: parameters, d, v, d₀, v₀, dt, committed history; trial history, f, k, c,
/// energies; 0 or why there is no answer.
pub type RespondFunction = unsafe extern "C" fn(
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    f64,
    *const f64,
    *mut f64,
    *mut f64,
    *mut f64,
    *mut f64,
    *mut f64,
) -> i32;

#[repr(C)]
struct RawParameter {
    name: *const c_char,
    unit: *const c_char,
    meaning: *const c_char,
    range: i32,
    low: f64,
    high: f64,
    default_value: f64,
}

#[repr(C)]
struct RawField {
    name: *const c_char,
    unit: *const c_char,
}

#[repr(C)]
struct RawLaw {
    abi: u32,
    flags: u32,
    kind: *const c_char,
    summary: *const c_char,
    law: *const c_char,
    source: *const c_char,
    axes: *const c_char,
    parameter_count: usize,
    parameters: *const RawParameter,
    history_count: usize,
    history: *const RawField,
    amplitude: *const f64,
    frequency: f64,
    respond: Option<RespondFunction>,
    check: Option<unsafe extern "C" fn(*const f64) -> i32>,
    engaged: Option<unsafe extern "C" fn(*const f64, *mut f64)>,
    at_rest: Option<unsafe extern "C" fn(*const f64, *mut f64)>,
    message: Option<unsafe extern "C" fn(i32) -> *const c_char>,
}

/// A function by its address, with what keeps it alive.
struct Address {
    respond: RespondFunction,
    sizes: Sizes,
    _keep: Arc<dyn Any + Send + Sync>,
}

impl Address {
    #[inline]
    fn call(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> i32 {
        let Sizes { parameters: p, coordinates: n, history: h } = self.sizes;
        let Kinematics { d, v, d0, v0, dt, .. } = *at;
        let Response { f, k, c, energy, .. } = out;
        // One by one: lists of lengths would be compared by a call.
        let fits = (parameters.len() == p)
            & (d.len() == n)
            & (v.len() == n)
            & (d0.len() == n)
            & (v0.len() == n)
            & (f.len() == n)
            & (k.len() == n * n)
            & (c.len() == n * n)
            & (committed.len() == h)
            & (trial.len() == h);
        assert!(fits, "lists of other lengths than the law declares");
        let mut told = [energy.stored, energy.hysteretic, energy.viscous];
        // SAFETY: the function has this signature and keeps to these lengths, by what the module rests on; all lists have them.
        let status = unsafe {
            (self.respond)(
                parameters.as_ptr(),
                d.as_ptr(),
                v.as_ptr(),
                d0.as_ptr(),
                v0.as_ptr(),
                dt,
                committed.as_ptr(),
                trial.as_mut_ptr(),
                f.as_mut_ptr(),
                k.as_mut_ptr(),
                c.as_mut_ptr(),
                told.as_mut_ptr(),
            )
        };
        [energy.stored, energy.hysteretic, energy.viscous] = told;
        status
    }
}

/// A law of a library.
pub(crate) struct InLibrary {
    address: Address,
    kind: String,
    check: Option<unsafe extern "C" fn(*const f64) -> i32>,
    engaged: Option<unsafe extern "C" fn(*const f64, *mut f64)>,
    at_rest: Option<unsafe extern "C" fn(*const f64, *mut f64)>,
    message: Option<unsafe extern "C" fn(i32) -> *const c_char>,
}

impl fmt::Debug for InLibrary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of a library", self.kind)
    }
}

impl InLibrary {
    /// What a status means.
    fn said(&self, status: i32) -> String {
        // SAFETY: by the header, a constant text or nothing.
        let text = self.message.and_then(|message| unsafe { text(message(status)) });
        text.unwrap_or_else(|| format!("{} returned {status}", self.kind))
    }
}

impl LawFunction for InLibrary {
    fn respond(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        match self.address.call(parameters, at, committed, trial, out) {
            0 => Ok(()),
            status if status > 0 => Err(NoAnswer::Refused(self.said(status))),
            status => Err(NoAnswer::Failed(self.said(status))),
        }
    }

    fn check(&self, parameters: &[f64]) -> Result<(), String> {
        assert_eq!(parameters.len(), self.address.sizes.parameters);
        // SAFETY: as for a call of the law.
        let status = self.check.map_or(0, |check| unsafe { check(parameters.as_ptr()) });
        if status == 0 { Ok(()) } else { Err(self.said(status)) }
    }

    fn engaged(&self, parameters: &[f64], k: &mut [f64]) -> Result<bool, String> {
        let Sizes { parameters: p, coordinates: n, .. } = self.address.sizes;
        assert!(parameters.len() == p && k.len() == n * n);
        let Some(engaged) = self.engaged else { return Ok(false) };
        // SAFETY: as for a call of the law.
        unsafe { engaged(parameters.as_ptr(), k.as_mut_ptr()) };
        Ok(true)
    }

    fn at_rest(&self, parameters: &[f64], history: &mut [f64]) -> Result<(), String> {
        let Sizes { parameters: p, history: h, .. } = self.address.sizes;
        assert!(parameters.len() == p && history.len() == h);
        if let Some(at_rest) = self.at_rest {
            // SAFETY: as for a call of the law.
            unsafe { at_rest(parameters.as_ptr(), history.as_mut_ptr()) };
        }
        Ok(())
    }
}

/// A law as machine code at an address, beside the same in a form that can say what is wrong: where the code returns
/// another status than 0, the other is asked, and its words are told.
#[derive(Debug)]
pub struct Compiled<F> {
    address: Address,
    plain: F,
}

impl fmt::Debug for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a function by its address")
    }
}

impl<F: LawFunction> Compiled<F> {
    /// Of an address; `keep` is what holds the code, and is let go with the last law.
    ///
    /// # Safety
    /// At the address is a function of the type [`RespondFunction`] that reads and writes lists of these sizes and nothing
    /// else, may be called from any thread, does not unwind, and is there as long as `keep` is.
    #[must_use]
    pub unsafe fn new(
        address: usize,
        sizes: Sizes,
        keep: Arc<dyn Any + Send + Sync>,
        plain: F,
    ) -> Option<Self> {
        let pointer = std::ptr::with_exposed_provenance::<()>(address);
        // SAFETY: a pointer to a function has the size of an address, and an option of it none for zero.
        let respond = unsafe { std::mem::transmute::<*const (), Option<RespondFunction>>(pointer) };
        respond.map(|respond| Self { address: Address { respond, sizes, _keep: keep }, plain })
    }
}

impl<F: LawFunction> LawFunction for Compiled<F> {
    fn respond(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        if self.address.call(parameters, at, committed, trial, out) == 0 {
            return Ok(());
        }
        self.plain.respond(parameters, at, committed, trial, out)?;
        let message = "it fails where it is compiled and answers where it is not";
        Err(NoAnswer::Failed(message.into()))
    }

    fn check(&self, parameters: &[f64]) -> Result<(), String> {
        self.plain.check(parameters)
    }

    fn engaged(&self, parameters: &[f64], k: &mut [f64]) -> Result<bool, String> {
        self.plain.engaged(parameters, k)
    }

    fn at_rest(&self, parameters: &[f64], history: &mut [f64]) -> Result<(), String> {
        self.plain.at_rest(parameters, history)
    }
}

/// The list of laws that a library exports.
pub(crate) struct List {
    at: unsafe extern "C" fn(usize) -> *const RawLaw,
    library: Arc<raw::Library>,
}

/// A law of such a list.
pub(crate) struct Table {
    pub declaration: Declaration,
    pub function: InLibrary,
}

/// The list of a library, where it has one.
pub(crate) fn exported(library: &Arc<raw::Library>) -> Option<List> {
    // SAFETY: who exports this name means the function of the header.
    let at = unsafe { library.symbol("trilith_law_at") }.ok()?;
    Some(List { at, library: Arc::clone(library) })
}

/// A text that ends in zero.
///
/// # Safety
/// It is one, or null.
unsafe fn text(at: *const c_char) -> Option<String> {
    // SAFETY: by what the caller says.
    (!at.is_null()).then(|| unsafe { CStr::from_ptr(at) }.to_string_lossy().into_owned())
}

/// A list of a table.
///
/// # Safety
/// There are so many, or the pointer is null.
unsafe fn list<'a, T>(at: *const T, count: usize, of: &str) -> Result<&'a [T], String> {
    if count == 0 {
        return Ok(&[]);
    }
    if count > MOST || at.is_null() {
        return Err(format!(
            "its table says that it has {count} {of}, and where they are: nowhere"
        ));
    }
    // SAFETY: by what the caller says.
    Ok(unsafe { std::slice::from_raw_parts(at, count) })
}

impl List {
    /// The law of that index; none behind the last.
    pub fn at(&self, index: usize) -> Result<Option<Table>, String> {
        // SAFETY: the function of the header takes any index.
        let raw = unsafe { (self.at)(index) };
        if raw.is_null() {
            return Ok(None);
        }
        // The number of the contract stands first, whatever the rest is.
        // SAFETY: the library says that there is a table here.
        let abi = unsafe { raw.cast::<u32>().read() };
        if abi != ABI {
            return Err(format!(
                "it is made for the contract {abi} of trilith_link.h, and this program knows {ABI}: compile it with the header of this version"
            ));
        }
        // SAFETY: a table of this contract.
        let law = unsafe { &*raw };
        let known = RATES | TANGENT | ENERGY;
        if law.flags & !known != 0 {
            return Err(format!("its flags are {:#x}, and there are {known:#x}", law.flags));
        }
        let respond = law.respond.ok_or("it has no function `respond`")?;
        // SAFETY: texts and lists of the table are what the header says.
        let declaration = unsafe { declaration(law) }?;
        let sizes = Sizes {
            parameters: declaration.parameters.len(),
            coordinates: declaration.axes.len(),
            history: declaration.history.len(),
        };
        let address = Address { respond, sizes, _keep: Arc::clone(&self.library) as _ };
        let RawLaw { check, engaged, at_rest, message, .. } = *law;
        let kind = declaration.kind.clone();
        let function = InLibrary { address, kind, check, engaged, at_rest, message };
        Ok(Some(Table { declaration, function }))
    }
}

/// # Safety
/// A table whose texts and lists are what the header says.
unsafe fn declaration(law: &RawLaw) -> Result<Declaration, String> {
    // SAFETY: by what the caller says, here and below.
    let said = |at| unsafe { text(at) };
    let wanted = |at, what: &str| said(at).ok_or_else(|| format!("it has no {what}"));
    let axes: Vec<String> =
        wanted(law.axes, "axes")?.split_whitespace().map(str::to_owned).collect();
    let raw = unsafe { list(law.parameters, law.parameter_count, "parameters") }?;
    let parameter = |p: &RawParameter| {
        let name = wanted(p.name, "name of a parameter")?;
        let range = match p.range {
            0 => DeclaredRange::Any,
            1 => DeclaredRange::Positive,
            2 => DeclaredRange::NonNegative,
            3 => DeclaredRange::Within(p.low, p.high),
            4 => DeclaredRange::Above(p.low, p.high),
            other => return Err(format!("the range of `{name}` is {other}, which is none")),
        };
        let default = Some(p.default_value).filter(|x| !x.is_nan()).map(DeclaredValue::Number);
        let unit = wanted(p.unit, &format!("unit of `{name}`"))?;
        let meaning = said(p.meaning).unwrap_or_default();
        Ok(DeclaredParameter { name, unit, meaning, range, default, example: None })
    };
    let parameters = raw.iter().map(parameter).collect::<Result<_, _>>()?;
    let raw = unsafe { list(law.history, law.history_count, "history variables") }?;
    let field = |f: &RawField| {
        let name = wanted(f.name, "name of a history variable")?;
        let unit = wanted(f.unit, &format!("unit of `{name}`"))?;
        Ok::<_, String>(DeclaredField { name, unit })
    };
    let history = raw.iter().map(field).collect::<Result<_, _>>()?;
    let amplitude = if law.amplitude.is_null() {
        Vec::new()
    } else {
        unsafe { list(law.amplitude, axes.len(), "amplitudes") }?.to_vec()
    };
    Ok(Declaration {
        kind: wanted(law.kind, "kind")?,
        summary: said(law.summary).unwrap_or_default(),
        law: said(law.law).unwrap_or_default(),
        source: said(law.source).unwrap_or_default(),
        axes,
        parameters,
        history,
        rates: law.flags & RATES != 0,
        tangent: law.flags & TANGENT != 0,
        energy: law.flags & ENERGY != 0,
        amplitude,
        frequency: law.frequency,
    })
}
