//! Named tables of a scene in the order in which they were typed.

use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error as _};
use serde::ser::{Serialize, Serializer};
use toml::map::Map;

pub(super) fn serialize<T: Serialize, S: Serializer>(map: &Map<String, T>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(map)
}

pub(super) fn deserialize<'de, T: DeserializeOwned, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Map<String, T>, D::Error> {
    let typed = toml::Table::deserialize(deserializer)?;
    let read = |(name, value): (String, toml::Value)| Ok((name, value.try_into().map_err(D::Error::custom)?));
    typed.into_iter().map(read).collect()
}
