//! The grains of a run on its page: to be turned, played and looked into, as `tsubu view` shows them.

use tsubu_frame::{Table, read_frame, snapshots};
use tsubu_view::embedded::{Run, embed};

use crate::page::Block;
use crate::source::Source;

/// Most rows of the history that the page carries for its curves.
const ROWS: usize = 400;

/// The view of a run's snapshots; nothing where it has none.
pub(crate) fn view(source: &mut Source, history: Option<&Table>) -> Option<Block> {
    let read = snapshots(&source.dir);
    let found = source.told(read).unwrap_or_default();
    let title = source.title();
    let history = history.map(|table| thinned(table).to_csv()).unwrap_or_default();
    let scene = source.text("scene.toml").unwrap_or_default();
    let run = Run { name: &title, history: &history, scene: &scene };
    let made = embed(found.len(), &run, &mut |number| read_frame(&found[number].path));
    let view = source.told(made)??;
    let caption = format!("The grains, to be turned, played and looked into. {}", view.left_out);
    Some(Block::View { html: view.html, caption })
}

/// Rows from the first to the last, no more than [`ROWS`].
fn thinned(table: &Table) -> Table {
    let last = table.rows.len().saturating_sub(1);
    let step = last.div_ceil(ROWS).max(1);
    let rows = table.rows.iter().enumerate().filter(|(place, _)| place % step == 0 || *place == last);
    Table { header: table.header.clone(), rows: rows.map(|(_, row)| row.clone()).collect() }
}
