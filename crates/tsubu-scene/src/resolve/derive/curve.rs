//! The measured response curve of a calibration: read from a file, or typed.

use super::table::{self, OF_RESPONSE};
use super::{Derive, list};
use crate::complaint::Complaint;
use crate::header::{self, Header};
use crate::lines::lines;
use crate::plan::Responded;
use toml::Value;

/// The table of the curve.
const PATH: [&str; 2] = ["calibrate", "curve"];
/// What it holds, beside what was measured.
const COLUMNS: [&str; 3] = ["frequency", "value", "uncertainty"];

impl Derive<'_> {
    /// Reads the file of the curve, or checks what was typed.
    pub(super) fn curve(&mut self, resolved: &mut toml::Table) {
        let calibrate = resolved.get_mut("calibrate").and_then(Value::as_table_mut);
        let Some(curve) = calibrate.and_then(|table| table.get_mut("curve")).and_then(Value::as_table_mut) else {
            return;
        };
        match curve.remove("file") {
            Some(Value::String(file)) => {
                let Some((quantity, columns)) = self.filed_curve(&file) else { return };
                curve.insert("quantity".into(), quantity.name().into());
                for (key, column) in COLUMNS.into_iter().zip(columns) {
                    curve.insert(key.into(), list(column));
                }
            }
            _ => self.typed_curve(curve),
        }
    }

    fn filed_curve(&mut self, file: &str) -> Option<(Responded, Vec<Vec<f64>>)> {
        self.filed(file, &PATH, |text, source| {
            let quantity = quantity(text, source).map_err(|wrong| vec![wrong])?;
            let dimension = quantity.dimension();
            Ok((quantity, table::read(text, source, &OF_RESPONSE, &[dimension, dimension])?))
        })
    }

    fn typed_curve(&mut self, curve: &toml::Table) {
        let nothing = Complaint::new("[calibrate.curve] has no curve")
            .at(&self.root.locate(&PATH), "needs `file`, or `quantity`, `frequency`, `value` and `uncertainty`")
            .hint("file = \"measured.csv\", with a header such as: frequency [Hz], transmissibility, uncertainty");
        if self.typed(&[&PATH[..], &["quantity"]].concat()) {
            self.typed_columns(curve, (&PATH, COLUMNS), &OF_RESPONSE, nothing);
        } else if !self.typed(&[&PATH[..], &["file"]].concat()) {
            self.complain(nothing);
        }
    }
}

/// What a file has in its second column, which its header tells.
fn quantity(text: &str, source: usize) -> Result<Responded, Complaint> {
    let known = || format!("one of: {}", Responded::ALL.map(|one| format!("`{}`", one.column())).join(", "));
    let example = "for example: frequency [Hz], rms displacement [mm], uncertainty [mm]";
    let Some(line) = lines(text).find(|line| !line.text.is_empty() && !line.text.starts_with('#')) else {
        return Err(Complaint::new("the file has no lines").hint(example));
    };
    let cells = header::cells(&line, line.separator());
    let Some(second) = cells.get(1).filter(|cell| header::is_name(cell.text)) else {
        return Err(Complaint::new("a measured response curve needs a header, which tells what was measured")
            .at(&line.place(source), "the first line")
            .hint(example));
    };
    if let Some(third) = cells.get(2)
        && Header::read(*third, source)?.name.to_lowercase() != "uncertainty"
    {
        return Err(Complaint::new(format!("the third column is `{}`", third.text))
            .at(&third.place(source), "must be the `uncertainty` of the second")
            .hint("the standard uncertainty: of two in three measurements the truth lies within it"));
    }
    let header = Header::read(*second, source)?;
    let name = header.name.to_lowercase().replace(['_', '-'], " ");
    Responded::ALL.into_iter().find(|one| one.column() == name).ok_or_else(|| {
        Complaint::new(format!("`{}` is nothing that a response tells", header.name))
            .at(&second.place(source), known())
            .hint(example)
    })
}
