//! Walls: depths of boxes, forces of servos, triangles of meshes.

use super::{Derive, is_space, table_at, tables_in};
use crate::complaint::Complaint;
use crate::grain_file::How;
use crate::plan::Size;
use toml::Value;

impl Derive<'_> {
    pub(super) fn walls(&mut self, resolved: &mut toml::Table) {
        let space = is_space(resolved);
        let groups = table_at(resolved, "particles").into_iter().flat_map(|groups| groups.iter());
        let largest = groups.filter_map(|(_, group)| self.largest(group, space)).reduce(f64::max);
        for (name, wall) in tables_in(resolved, "walls") {
            self.depth(wall, &name, space, largest);
            self.force(wall, &name);
            self.mesh(wall, &name);
        }
    }

    /// The largest diameter of a group.
    fn largest(&self, group: &Value, space: bool) -> Option<f64> {
        let size: Option<Size> = group.get("size").and_then(|size| size.clone().try_into().ok());
        let file = group.get("start").and_then(|start| start.get("file"));
        let kind = file.and_then(|file| file.get("kind")?.as_integer()).and_then(|kind| u32::try_from(kind).ok());
        let path = file.and_then(|file| file.get("path")?.as_str());
        let in_file = path.and_then(|path| self.files.largest_diameter(path, How { space, kind }));
        in_file.or_else(|| size?.ends().map(|ends| ends[1])).or_else(|| group.get("diameter")?.as_float())
    }

    fn depth(&mut self, wall: &mut toml::Table, name: &str, space: bool, largest: Option<f64>) {
        let path = ["walls", name, "shape", "box", "depth"];
        let Some(shape) = wall.get_mut("shape").and_then(|shape| shape.get_mut("box")).and_then(Value::as_table_mut)
        else {
            return;
        };
        if shape.contains_key("depth") || self.typed(&path) {
            return;
        }
        if space {
            self.complain(
                Complaint::new(format!("missing key `depth` in [walls.{name}.shape.box]"))
                    .at(&self.root.locate(&path), "needs `depth`")
                    .hint("`depth`: Inner size along y; only a scene in the plane can do without"),
            );
        } else if let Some(depth) = largest.or_else(|| shape.get("width").and_then(Value::as_float)) {
            shape.insert("depth".into(), Value::Float(depth));
        }
    }

    /// A force, or a pressure on an area.
    fn force(&mut self, wall: &mut toml::Table, name: &str) {
        let Some(servo) = wall.get_mut("servo").and_then(Value::as_table_mut) else { return };
        if let Some(area) = servo.remove("area").and_then(|area| area.as_float())
            && let Some(pressure) = servo.remove("pressure").and_then(|pressure| pressure.as_float())
        {
            servo.insert("force".into(), Value::Float(pressure * area));
        }
        let path = ["walls", name, "servo"];
        let typed = |key: &str| self.typed(&[&path[..], &[key]].concat());
        let label = match (typed("force"), typed("pressure"), typed("area")) {
            // A pressure alone acts on the face of a box, which is looked for later.
            (true, ..) | (_, true, _) => return,
            (_, false, true) => "`area` needs a `pressure`",
            (_, false, false) => "needs `force`, or `pressure` and `area`",
        };
        self.complain(
            Complaint::new(format!("the force of the wall `{name}` is not known"))
                .at(&self.root.locate(&path), label)
                .hint("force = \"20 N\"")
                .hint("or pressure = \"10 kPa\" and area = \"20 cm^2\""),
        );
    }

    fn mesh(&mut self, wall: &mut toml::Table, name: &str) {
        let Some(mesh) = wall.get_mut("shape").and_then(|shape| shape.get_mut("mesh")).and_then(Value::as_table_mut)
        else {
            return;
        };
        let Some(path) = mesh.get("path").and_then(Value::as_str).map(str::to_string) else { return };
        let here = ["walls", name, "shape", "mesh"];
        match self.files.mesh(&path, self.sources) {
            Ok(_) => self.fingerprint(mesh, &here, &path),
            Err(wrong) => self.file_is_wrong(wrong, &[&here[..], &["path"]].concat()),
        }
    }
}
