//! The frame: time and named columns with units, whatever the method.

/// What the rows of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// One row a grain.
    Grain,
    /// One row a touching pair.
    Contact,
    /// One row a lattice cell.
    Cell,
    /// One row a vertex of a wall; consecutive rows of equal `outline` index form a closed line, or a polygon where
    /// the column `face` is not 0.
    Surface,
    /// Of no row in particular: mostly one row in all. Where grains have outlines, `shape of corner` and `corner` have a
    /// row a corner; consecutive rows of equal shape form a closed line round the position of grains of that `shape`.
    Global,
}

/// The numbers of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Real numbers.
    Scalar(Vec<f64>),
    /// 3-vectors.
    Vector(Vec<[f64; 3]>),
    /// Unit quaternions: the real part, then x, y, z.
    Quaternion(Vec<[f64; 4]>),
    /// Whole numbers: ids, indices.
    Integer(Vec<i64>),
}

impl Values {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Scalar(v) => v.len(),
            Self::Vector(v) => v.len(),
            Self::Quaternion(v) => v.len(),
            Self::Integer(v) => v.len(),
        }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A named column with a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the field's terms, lower case: `position`, `velocity`, `spin`, `radius`, `mass`, `id`.
    pub name: &'static str,
    /// SI unit, `-` for none.
    pub unit: &'static str,
    /// What the rows are.
    pub kind: Kind,
    /// The numbers.
    pub values: Values,
}

/// One moment of a run. Grain columns are in the order of grain ids.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Simulated time [s].
    pub time: f64,
    /// Step number.
    pub step: u64,
    /// The columns.
    pub columns: Vec<Column>,
}

impl Frame {
    /// The column of that kind and name.
    pub fn column(&self, kind: Kind, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.kind == kind && c.name == name)
    }

    /// The columns of one kind.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Column> {
        self.columns.iter().filter(move |c| c.kind == kind)
    }

    /// Rows of one kind.
    pub fn rows(&self, kind: Kind) -> usize {
        self.of(kind).next().map_or(0, |c| c.values.len())
    }

    /// Adds a column of real numbers.
    pub fn scalar(&mut self, kind: Kind, name: &'static str, unit: &'static str, values: Vec<f64>) {
        self.columns.push(Column { name, unit, kind, values: Values::Scalar(values) });
    }

    /// Adds a column of 3-vectors.
    pub fn vector(&mut self, kind: Kind, name: &'static str, unit: &'static str, values: Vec<[f64; 3]>) {
        self.columns.push(Column { name, unit, kind, values: Values::Vector(values) });
    }

    /// Adds a column of orientations.
    pub fn quaternion(&mut self, kind: Kind, name: &'static str, values: Vec<[f64; 4]>) {
        self.columns.push(Column { name, unit: "-", kind, values: Values::Quaternion(values) });
    }

    /// The real numbers of a column; empty if there is no such column.
    pub fn scalars(&self, kind: Kind, name: &str) -> &[f64] {
        match self.column(kind, name).map(|c| &c.values) {
            Some(Values::Scalar(v)) => v,
            _ => &[],
        }
    }

    /// The 3-vectors of a column; empty if there is no such column.
    pub fn vectors(&self, kind: Kind, name: &str) -> &[[f64; 3]] {
        match self.column(kind, name).map(|c| &c.values) {
            Some(Values::Vector(v)) => v,
            _ => &[],
        }
    }

    /// The whole numbers of a column; empty if there is no such column.
    pub fn integers(&self, kind: Kind, name: &str) -> &[i64] {
        match self.column(kind, name).map(|c| &c.values) {
            Some(Values::Integer(v)) => v,
            _ => &[],
        }
    }

    /// The cell of the periodic axes, if there are any: low and high corner [m], and 1 for each axis that repeats.
    pub fn periodic(&self) -> Option<[[f64; 3]; 3]> {
        let one = |name| self.vectors(Kind::Global, name).first().copied();
        Some([one("periodic low")?, one("periodic high")?, one("periodic")?])
    }

    /// Adds a column of whole numbers.
    pub fn integer(&mut self, kind: Kind, name: &'static str, unit: &'static str, values: Vec<i64>) {
        self.columns.push(Column { name, unit, kind, values: Values::Integer(values) });
    }
}
