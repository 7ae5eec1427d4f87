//! A run that is looked at in the browser while it goes on.

use crate::failure::Failure;
use crate::{output, stop};
use clap::Args;
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use tsubu::run::{Onlooker, Wish};
use tsubu_frame::{Frame, Status, Summary};
use tsubu_scene::Plan;
use tsubu_view::{Live, Server, ViewError};

/// Where the page is.
#[derive(Args, Clone, Copy)]
pub struct PageOptions {
    /// Port to listen on [default: any that is free]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Do not open the page in a browser
    #[arg(long)]
    pub no_open: bool,
}

impl PageOptions {
    /// Says where the page is, and opens it where somebody sits at a terminal.
    pub fn open(self, address: &str) -> Result<(), Failure> {
        output::print(&format!("{address}\n"))?;
        if !self.no_open && std::io::stdout().is_terminal() {
            // The address is on the terminal, for machines without a browser.
            let _ = open::that_detached(address);
        }
        Ok(())
    }
}

/// A run and the server of its page.
pub struct LookedAt {
    live: Arc<Live>,
    over: Arc<AtomicBool>,
    server: Option<JoinHandle<Result<(), ViewError>>>,
}

/// How often the end is asked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// How long pages have to fetch the last moment of a run that was stopped.
const FAREWELL: Duration = Duration::from_secs(3);

impl LookedAt {
    /// Begins to serve a run that is about to begin.
    pub fn begin(name: String, plan: &Plan, page: PageOptions) -> Result<Self, Failure> {
        let stop = Box::new(|| _ = stop::interrupt(stop::NOT_BEGUN).ask());
        let live = Live::new(name, plan.method.name(), u32::from(plan.dimension), stop);
        let live = Arc::new(live.with_groups(plan.particles.keys().cloned().collect()));
        let server = Server::of_live(live.clone(), page.port).map_err(|error| Failure::of_words(&error))?;
        page.open(&server.address())?;
        let over = Arc::new(AtomicBool::new(false));
        let asked = over.clone();
        let server = thread::spawn(move || server.serve(&|| asked.load(Ordering::Relaxed)));
        Ok(Self { live, over, server: Some(server) })
    }

    /// Tells the page how the run ended. One that came to its end is shown as long as a page is open; else the page has a moment to
    /// fetch what is left.
    pub fn end(mut self, summary: Option<Summary>, told: String) {
        let finished = summary.as_ref().is_some_and(|summary| summary.status == Status::Finished);
        let word = summary.as_ref().map_or("failed", |summary| summary.status.word());
        let looked = self.live.is_looked_at();
        self.live.end(word, told, summary);
        if finished && looked {
            output::tell("the page is open: close it, or press Ctrl-C, to end\n");
        }
        let begun = Instant::now();
        let stays = || if finished { !stop::is_asked() } else { begun.elapsed() < FAREWELL };
        stop::nothing_to_save();
        while self.live.is_looked_at() && stays() {
            thread::sleep(PATIENCE);
        }
        self.over.store(true, Ordering::Relaxed);
        if let Some(server) = self.server.take() {
            let _ = server.join();
        }
    }
}

impl Onlooker for LookedAt {
    fn stage(&self, number: usize, name: &str, verdicts: &str) {
        self.live.stage(number, name, verdicts);
    }

    fn row(&self, columns: &[String], row: &[f64]) {
        self.live.row(columns, row);
    }

    fn moved(&self, time: f64, steps: u64, share: f64) {
        self.live.moved(time, steps, share);
    }

    fn wish(&self) -> Wish {
        match self.live.wish() {
            None => Wish::Nothing,
            Some(false) => Wish::Grains,
            Some(true) => Wish::Contacts,
        }
    }

    fn frame(&self, frame: Frame, cost: Duration) {
        self.live.frame(frame, cost);
    }

    fn paused(&self) -> bool {
        self.live.paused()
    }
}
