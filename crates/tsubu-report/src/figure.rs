//! A figure: what is to be seen, without how it is drawn.
//!
//! The drawing itself is one module behind this type, so that another plotting library costs one file.

/// An axis: what it shows and in which unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// What is shown.
    pub label: String,
    /// SI unit of the numbers, `-` for none. The drawing picks a prefix (`mm`, `mJ`) that makes short numbers.
    pub unit: String,
    /// Logarithmic; values that are not positive are left out.
    pub log: bool,
}

impl Axis {
    /// A linear axis.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), log: false }
    }

    /// The same axis, logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.log = true;
        self
    }

    /// An axis from a header cell, `name [unit]`.
    pub fn from_header(header: &str) -> Self {
        let (name, unit) = tsubu_frame::csv::split_unit(header);
        Self::new(name, unit.unwrap_or("-"))
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A line.
    #[default]
    Line,
    /// A dashed line.
    Dashed,
    /// Points alone.
    Points,
    /// A line through points.
    LineAndPoints,
}

/// A named curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name in the legend; empty keeps it out.
    pub name: String,
    /// Points; those that are not finite are left out.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub style: Style,
    /// Lower and upper end of the spread at each point.
    pub band: Option<Vec<(f64, f64)>>,
    /// Index in the palette, if it is to share a colour with another series.
    pub colour: Option<usize>,
}

impl Series {
    /// A line.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, ..Self::default() }
    }

    /// The same series in another style.
    #[must_use]
    pub fn styled(mut self, style: Style) -> Self {
        self.style = style;
        self
    }

    /// The same series with its spread.
    #[must_use]
    pub fn with_band(mut self, band: Vec<(f64, f64)>) -> Self {
        self.band = Some(band);
        self
    }
}

/// A dashed reference line across the figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Where: an x, or a y if `horizontal`.
    pub at: f64,
    /// From left to right rather than from bottom to top.
    pub horizontal: bool,
    /// Text at its end; empty for none.
    pub label: String,
    /// Index in the palette, if it belongs to a series.
    pub colour: Option<usize>,
}

impl Mark {
    /// At this x, from bottom to top.
    pub fn vertical(at: f64, label: impl Into<String>) -> Self {
        Self { at, label: label.into(), ..Self::default() }
    }

    /// At this y, from left to right.
    pub fn horizontal(at: f64, label: impl Into<String>) -> Self {
        Self { at, horizontal: true, label: label.into(), ..Self::default() }
    }
}

/// Bars by category, one colour a part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bars {
    /// Names of the categories.
    pub categories: Vec<String>,
    /// Each part: name and one value a category.
    pub parts: Vec<(String, Vec<f64>)>,
    /// Parts on top of one another rather than side by side.
    pub stacked: bool,
    /// Categories from top to bottom, for long names.
    pub horizontal: bool,
}

/// A figure with axes, curves or bars.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Title; empty for none.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Curves.
    pub series: Vec<Series>,
    /// Reference lines.
    pub marks: Vec<Mark>,
    /// Bars, instead of curves.
    pub bars: Option<Bars>,
    /// Height of the drawing area in pixels; 0 for the default.
    pub height: u32,
    /// Its width; 0 for that of the page.
    pub width: u32,
}

impl Figure {
    /// A figure with its axes.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, ..Self::default() }
    }

    /// A bar chart; `value` says what the bars measure.
    pub fn of_bars(title: impl Into<String>, value: Axis, bars: Bars) -> Self {
        Self { title: title.into(), y: value, bars: Some(bars), ..Self::default() }
    }

    /// Adds a curve.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a reference line.
    #[must_use]
    pub fn marked(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// Whether there is nothing to see.
    pub fn is_empty(&self) -> bool {
        !self.has(f64::is_finite)
    }

    /// Whether every value is zero, or there is none: not worth its place on a page.
    pub(crate) fn is_idle(&self) -> bool {
        !self.has(|value| value.is_finite() && value != 0.0)
    }

    /// Whether it has a value like this.
    fn has(&self, like: impl Fn(f64) -> bool) -> bool {
        let drawn = |s: &Series| s.points.iter().any(|(x, y)| x.is_finite() && like(*y));
        let bars = self.bars.iter().filter(|bars| !bars.categories.is_empty()).flat_map(|bars| &bars.parts);
        self.series.iter().any(drawn) || bars.flat_map(|(_, values)| values).any(|value| like(*value))
    }
}

/// An SVG drawing with a white ground, for readers whose own ground is dark.
pub(crate) fn on_white(svg: &str) -> String {
    match svg.split_once('>') {
        Some((head, body)) => {
            format!("{head}><rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>{body}")
        }
        None => svg.to_owned(),
    }
}
