// Superellipsoids and polyhedra, as crates/tsubu-report/src/solid.rs draws them: where a line of sight meets one within the sphere that holds it.

import * as three from "./three.min.js";

// What a frame says of each body: names of its arrays, of the attributes, and numbers a row.
export const COLUMNS = [["turned", "turned", 4], ["semi-axes", "axes", 3], ["exponents", "exponents", 2], ["polyhedron", "polyhedron", 1]];

export const VERTEX = `
in vec4 turned; in vec3 axes; in vec2 exponents; in float polyhedron;
flat out mat3 turn; flat out vec3 semi; flat out vec2 powers; flat out int faces;
void body(mat3 view, float shrink) {
  float x = turned.x, y = turned.y, z = turned.z, w = turned.w;
  turn = view * mat3(
    1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y),
    2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x),
    2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y));
  semi = shrink * axes; powers = exponents; faces = int(round(polyhedron));
}`;

export const FRAGMENT = `
flat in mat3 turn; flat in vec3 semi; flat in vec2 powers; flat in int faces;
uniform highp sampler2D planes;

float joined(float a, float b, float power) {
  float most = max(a, b);
  return most * pow(pow(a / most, power) + pow(b / most, power), 1.0 / power);
}

// ((|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p)^(1/p), 1 on the surface, and its slope.
float level(vec3 at, out vec3 slope) {
  vec3 own = at / semi;
  vec3 part = max(abs(own), 1e-6);
  float equator = joined(part.x, part.y, powers.y);
  float level = joined(equator, part.z, powers.x);
  float share = pow(equator / level, powers.x - 1.0);
  slope = vec3(share * pow(part.xy / equator, vec2(powers.y - 1.0)), pow(part.z / level, powers.x - 1.0)) * sign(own) / semi;
  return level;
}

// The level is convex along the line: from outside Newton's steps never go too far.
bool meetsRound(inout vec3 at, vec3 along, float size, out vec3 normal) {
  float gone = 0.0;
  for (int step = 0; step < 40; step++) {
    vec3 slope;
    float over = level(at, slope) - 1.0;
    if (over <= 1e-4) {
      normal = normalize(slope);
      return true;
    }
    float towards = dot(slope, along);
    float way = -over / towards;
    gone += way;
    if (towards >= 0.0 || gone > 2.0 * size) return false;
    at += way * along;
  }
  return false;
}

// Within the rounding radius of an edge the normals of its faces are mixed. A polygon has sides alone: the plane that is looked at cuts it.
bool meetsFaces(inout vec3 at, vec3 along, float size, bool flatland, out vec3 normal, out bool edge) {
  vec2 about = texelFetch(planes, ivec2(0, faces), 0).xy;
  float near = -1e30, far = 1e30;
  for (int k = 1; k <= int(about.x); k++) {
    vec4 plane = texelFetch(planes, ivec2(k, faces), 0);
    float rest = 2.0 * size * plane.w - dot(plane.xyz, at), towards = dot(plane.xyz, along);
    if (abs(towards) < 1e-6) { if (rest < 0.0) return false; }
    else if (towards < 0.0) near = max(near, rest / towards);
    else far = min(far, rest / towards);
  }
  if (flatland) near = max(near, -at.y / along.y);
  if (near > far) return false;
  at += near * along;
  normal = vec3(0.0);
  float rounding = 2.0 * size * max(about.y, 1e-3);
  int here = 0;
  for (int k = 1; k <= int(about.x); k++) {
    vec4 plane = texelFetch(planes, ivec2(k, faces), 0);
    float away = 2.0 * size * plane.w - dot(plane.xyz, at);
    float share = clamp(1.0 - away / rounding, 0.0, 1.0);
    normal += share * share * plane.xyz;
    here += int(away < 0.08 * size);
  }
  edge = here > (flatland ? 0 : 1);
  normal = flatland ? -along : normalize(normal);
  return true;
}

// From where a ray enters the sphere round the middle to where it meets the body.
bool meetsBody(vec3 middle, vec3 along, float size, bool flatland, inout vec3 hit, out vec3 normal, out bool edge) {
  vec3 at = (hit - middle) * turn, way = along * turn;
  edge = false;
  bool met = faces >= 0 ? meetsFaces(at, way, size, flatland, normal, edge) : meetsRound(at, way, size, normal);
  hit = middle + turn * at;
  normal = turn * normal;
  return met;
}`;

// The faces of all polyhedra of a frame, one polyhedron a row: how many, and the rounding radius; then normals and distances, for a diameter of 1.
export function planes({ faces, "face of": of, rounding }) {
  const rows = Array.from({ length: Math.max(1, rounding.length) }, () => []);
  of.forEach((number, face) => rows[number]?.push(...faces.subarray(4 * face, 4 * face + 4)));
  const width = Math.max(0, ...rows.map((row) => row.length));
  const data = new Float32Array((4 + width) * rows.length);
  rows.forEach((row, number) => data.set([row.length / 4, rounding[number] ?? 0, 0, 0, ...row], (4 + width) * number));
  const texture = new three.DataTexture(data, 1 + width / 4, rows.length, three.RGBAFormat, three.FloatType);
  texture.needsUpdate = true;
  return texture;
}
