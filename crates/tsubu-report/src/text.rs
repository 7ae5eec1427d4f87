//! Numbers and text for readers.

/// A number with about four figures, thousands apart, powers of ten where they are shorter.
pub fn short(x: f64) -> String {
    if x.is_nan() {
        return "–".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "∞".into() } else { "−∞".into() };
    }
    let size = x.abs();
    let text = if size == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e7).contains(&size) {
        let text = format!("{x:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        format!("{digits}·10{}", superscript(power))
    } else if size >= 1000.0 {
        grouped(&format!("{x:.0}"))
    } else {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    text.replace('-', "−")
}

/// A whole number, thousands apart.
pub fn count(n: u64) -> String {
    grouped(&n.to_string())
}

/// Seconds as a reader says them.
pub fn duration(seconds: f64) -> String {
    if !seconds.is_finite() {
        return "–".into();
    }
    if seconds < 1e-3 {
        format!("{} µs", short(seconds * 1e6))
    } else if seconds < 1.0 {
        format!("{} ms", short(seconds * 1e3))
    } else if seconds < 120.0 {
        format!("{} s", short(seconds))
    } else if seconds < 7200.0 {
        format!("{:.0} min {:02.0} s", (seconds / 60.0).floor(), (seconds % 60.0).floor())
    } else {
        format!("{:.0} h {:02.0} min", (seconds / 3600.0).floor(), (seconds % 3600.0 / 60.0).floor())
    }
}

fn grouped(digits: &str) -> String {
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits), |d| ("-", d));
    if digits.len() < 5 {
        return format!("{sign}{digits}");
    }
    let mut out = String::from(sign);
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            // A narrow space that does not break.
            out.push('\u{202f}');
        }
        out.push(c);
    }
    out
}

/// A unit as people write it: `m^2/s` with a raised 2, `N.s` with a dot in the middle.
pub(crate) fn unit(unit: &str) -> String {
    let mut out = String::new();
    let mut rest = unit;
    while let Some((before, after)) = rest.split_once('^') {
        let power = after.len() - after.trim_start_matches(|c: char| c.is_ascii_digit() || c == '-').len();
        out += &before.replace('.', "·");
        out += &superscript(&after[..power]);
        rest = &after[power..];
    }
    out + &rest.replace('.', "·")
}

/// Digits and sign raised.
pub(crate) fn superscript(power: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    power.chars().map(|c| if c == '-' { '⁻' } else { c.to_digit(10).map_or(c, |d| RAISED[d as usize]) }).collect()
}

/// Text as HTML: what stands between backticks is set as code. A lone backtick stays.
pub(crate) fn marked(text: &str) -> String {
    let parts: Vec<String> = text.split('`').map(escape).collect();
    let mut out = parts[0].clone();
    for pair in parts[1..].chunks(2) {
        match pair {
            [code, rest] => out.extend(["<code>", code, "</code>", rest]),
            lone => out.extend(["`", &lone[0]]),
        }
    }
    out
}

/// Text without the marks of code, for places that show plain text alone.
pub(crate) fn plain(text: &str) -> String {
    text.replace('`', "")
}

/// Text made safe for HTML and SVG. Control characters, which XML forbids, become visible.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' | '\r' => out.push(c),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}
