//! The server: a port on loopback, a token, and few threads that read frames.

use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::{Request, StatusCode};
use axum::response::{IntoResponse, Response};
use tokio::runtime::{Builder, Runtime};

use crate::ViewError;
use crate::answer::{Answer, answer, command, is_command};
use crate::folder::Folder;
use crate::live::Live;
use crate::source::Source;
use crate::{guard, token};

/// Requests that are worked on at the same time, each with one frame in memory at most.
const THREADS: usize = 3;

/// How often the server asks whether it is to stop.
const PATIENCE: Duration = Duration::from_millis(100);

/// What every answer carries: nothing from elsewhere is loaded, nobody frames the page, the token is told to nobody.
const HEADERS: [(&str, &str); 6] = [
    (
        "content-security-policy",
        "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    ),
    ("referrer-policy", "no-referrer"),
    ("x-content-type-options", "nosniff"),
    ("cross-origin-resource-policy", "same-origin"),
    ("cross-origin-opener-policy", "same-origin"),
    ("cache-control", "no-store"),
];

const PLAIN: &str = "text/plain; charset=utf-8";

/// A server of some runs.
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    room: Arc<Room>,
}

/// What requests are answered from.
struct Room {
    port: u16,
    token: String,
    sources: Vec<Source>,
}

impl Server {
    /// Opens the folders, and listens on a port of loopback; on any free one for 0.
    pub fn bind(folders: &[PathBuf], port: u16) -> Result<Self, ViewError> {
        let open = |path: &PathBuf| Folder::open(path).map(Source::Folder);
        Self::of(folders.iter().map(open).collect::<Result<_, _>>()?, port)
    }

    /// A server of a run that goes on in this program.
    pub fn of_live(live: Arc<Live>, port: u16) -> Result<Self, ViewError> {
        Self::of(vec![Source::Live(live)], port)
    }

    fn of(sources: Vec<Source>, port: u16) -> Result<Self, ViewError> {
        let token = token::draw()?;
        let refused = |source: io::Error| ViewError::Port { port, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        listener.set_nonblocking(true).map_err(refused)?;
        let port = listener.local_addr().map_err(refused)?.port();
        let runtime = Builder::new_current_thread().enable_all().max_blocking_threads(THREADS).build();
        let room = Arc::new(Room { port, token, sources });
        Ok(Self { runtime: runtime.map_err(refused)?, listener, room })
    }

    /// The address of the page, with its token.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.room.port, self.room.token)
    }

    /// Answers until `stop` says so. Whoever is still being answered then is left.
    pub fn serve(self, stop: &dyn Fn() -> bool) -> Result<(), ViewError> {
        let Self { runtime, listener, room } = self;
        let port = room.port;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let pages = Router::new().fallback(move |request: Request<Body>| respond(room.clone(), request));
            let work = tokio::spawn(async { axum::serve(listener, pages).await });
            while !stop() && !work.is_finished() {
                tokio::time::sleep(PATIENCE).await;
            }
            Ok(())
        });
        runtime.shutdown_background();
        served.map_err(|source| ViewError::Port { port, source })
    }
}

async fn respond(room: Arc<Room>, request: Request<Body>) -> Response {
    let (head, _) = request.into_parts();
    let Some(asked) = guard::admitted(&head.method, &head.uri, &head.headers, &room.token, room.port) else {
        return reply(StatusCode::FORBIDDEN, PLAIN, "refused: open the address that tsubu view printed\n".into());
    };
    let asked = asked.to_owned();
    let work = if is_command(&asked) { command } else { answer };
    let answered = tokio::task::spawn_blocking(move || work(&room.sources, &asked)).await;
    match answered.unwrap_or_else(|_| Answer::Broken("the server could not answer".to_owned())) {
        Answer::Bytes(kind, bytes) => reply(StatusCode::OK, kind, bytes.into()),
        Answer::Nothing => reply(StatusCode::NOT_FOUND, PLAIN, "there is no such thing\n".into()),
        Answer::Broken(why) => reply(StatusCode::INTERNAL_SERVER_ERROR, PLAIN, why.into()),
    }
}

fn reply(status: StatusCode, kind: &'static str, body: Body) -> Response {
    (status, HEADERS, [("content-type", kind)], body).into_response()
}
