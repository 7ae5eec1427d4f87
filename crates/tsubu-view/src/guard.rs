//! Who is let in: those who know the token, ask under this machine's own name, and come from this page or from none.
//!
//! A page of a stranger can send a browser here, under a name of its own that leads to this machine even. The token keeps it out; so
//! do the headers `Host` and `Origin`, which a page cannot choose.

use axum::http::{HeaderMap, Method, Uri};

use crate::answer::is_command;
use crate::token;

/// What stands behind the token in the address, for those who are let in. What changes what is done must be posted, which no address
/// that somebody follows can do.
pub fn admitted<'a>(method: &Method, uri: &'a Uri, headers: &HeaderMap, token: &str, port: u16) -> Option<&'a str> {
    let ours = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    let named = |host: &str| ours.iter().any(|name| name.eq_ignore_ascii_case(host));
    let said = |name: &str| headers.get_all(name).iter().map(|value| value.to_str().unwrap_or_default()).collect();
    let (hosts, origins): (Vec<&str>, Vec<&str>) = (said("host"), said("origin"));
    let host = matches!(hosts[..], [host] if named(host));
    let origin = origins.iter().all(|origin| origin.strip_prefix("http://").is_some_and(named));
    let asked = uri.path_and_query()?.as_str();
    let (word, rest) = asked.strip_prefix('/')?.split_once('/')?;
    let wanted = if is_command(rest) { Method::POST } else { Method::GET };
    (*method == wanted && host && origin && token::same(word, token)).then_some(rest)
}
