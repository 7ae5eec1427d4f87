// Grains: a square for each that faces the eye, on which a shader draws a sphere, or the body within it. In the plane they are discs and polygons.

import * as three from "./three.min.js";
import * as bodies from "./bodies.js";
import { texture } from "./palette.js";

const VERTEX = `
#ifdef BODIES${bodies.VERTEX}
#endif
in vec3 centre; in float radius; in float colour;
uniform vec4 cut; uniform int picked; uniform float shrink;
out float marked; out vec3 middle; out vec3 place; out float size; out float shade; flat out int row;
void main() {
  row = gl_InstanceID;
  #ifdef BODIES
  body(mat3(modelViewMatrix), shrink);
  #endif
  float small = shrink * radius;
  vec4 eye = modelViewMatrix * vec4(centre, 1.0);
  bool away = dot(cut.xyz, centre) > cut.w;
  marked = gl_InstanceID == picked ? 1.0 : 0.0;
  middle = eye.xyz; size = small; shade = colour;
  // Seen in perspective a sphere is larger than its radius: the square stands at its front, and is as large as the cone of sight there.
  bool parallel = projectionMatrix[3][3] == 1.0;
  float far = length(eye.xyz);
  float reach = parallel ? small : small * far / sqrt(max(far * far - small * small, 1e-4 * small * small));
  vec3 ahead = parallel ? vec3(0.0, 0.0, 1.0) : -normalize(eye.xyz);
  vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), ahead));
  vec3 up = cross(ahead, right);
  place = eye.xyz + 1.02 * reach * (position.x * right + position.y * up);
  gl_Position = away ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * vec4(place, 1.0);
}`;

const FRAGMENT = `
#ifdef BODIES${bodies.FRAGMENT}
#endif
in float marked; in vec3 middle; in vec3 place; in float size; in float shade; flat in int row;
uniform mat4 projectionMatrix;
uniform sampler2D palette; uniform vec2 range; uniform bool flatland; uniform vec3 missing;
out vec4 seen;
void main() {
  bool parallel = projectionMatrix[3][3] == 1.0;
  vec3 from = parallel ? vec3(place.xy, 0.0) : vec3(0.0);
  vec3 along = parallel ? vec3(0.0, 0.0, -1.0) : normalize(place);
  vec3 off = from - middle;
  float b = dot(off, along), c = dot(off, off) - size * size;
  float inside = b * b - c;
  if (inside < 0.0) discard;
  vec3 hit = from + (-b - sqrt(inside)) * along;
  vec3 normal = (hit - middle) / size;
  bool edge = false;
  #ifdef BODIES
  if (!meetsBody(middle, along, size, flatland, hit, normal, edge)) discard;
  #endif
  vec4 clip = projectionMatrix * vec4(hit, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  #ifdef ASKED
  seen = vec4((ivec4(row + 1) >> ivec4(0, 8, 16, 24)) & 255) / 255.0;
  #else
  float t = range.y > range.x ? (shade - range.x) / (range.y - range.x) : 0.35;
  // Half a texel from the ends, so that the ends have their own colours.
  vec3 paint = shade == shade ? texture(palette, vec2(clamp(t, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb : missing;
  float facing = edge && (flatland || marked > 0.5) ? 0.0 : max(dot(normal, -along), 0.0);
  float light = flatland ? (facing < 0.3 ? 0.6 : 1.0) : 0.3 + 0.7 * facing;
  seen = marked > 0.5 && facing < 0.6 ? vec4(0.98, 0.45, 0.05, 1.0) : vec4(paint * light, 1.0);
  #endif
}`;

const [palette, groups] = [texture(), new Map()];
const ofGroups = (count) => groups.get(count) ?? groups.set(count, texture(count)).get(count);

export class Grains {
  constructor() {
    this.geometry = new three.InstancedBufferGeometry();
    this.geometry.setAttribute("position", new three.BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.geometry.instanceCount = 0;
    const uniforms = {
      palette: { value: palette },
      range: { value: new three.Vector2(0, 1) },
      cut: { value: new three.Vector4(0, 0, 0, 1) },
      shrink: { value: 1 },
      picked: { value: -1 },
      flatland: { value: false },
      missing: { value: new three.Color(0x969696) },
      planes: { value: null },
    };
    const shaders = { vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, glslVersion: three.GLSL3 };
    this.material = new three.ShaderMaterial({ ...shaders, defines: {} });
    // Draws the numbers of grains instead of grains, for who asks which one is seen.
    this.asked = new three.ShaderMaterial({ ...shaders, defines: { ASKED: "" } });
    this.mesh = new three.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.capacity = 0;
  }

  // Colours stand for numbers of a range, or for so many groups.
  paint(range, things) {
    const { uniforms } = this.material;
    uniforms.palette.value = things ? ofGroups(things) : palette;
    uniforms.range.value.set(...(things ? [-0.5, things - 0.5] : range));
  }

  // Shows the grains of a frame. Buffers grow and are used again.
  show(frame) {
    const { grains, position, radius, colour } = frame;
    const columns = [["centre", 3, position], ["radius", 1, radius], ["colour", 1, colour]];
    if (frame.turned?.length) {
      columns.push(...bodies.COLUMNS.map(([name, attribute, size]) => [attribute, size, frame[name]]));
      this.drawBodies(frame);
    }
    if (grains > this.capacity) {
      this.capacity = Math.ceil(1.2 * grains);
      this.geometry.dispose();
      for (const [name, size] of columns) {
        const column = new three.InstancedBufferAttribute(new Float32Array(size * this.capacity), size);
        this.geometry.setAttribute(name, column.setUsage(three.DynamicDrawUsage));
      }
    }
    for (const [name, size, values] of columns) {
      const column = this.geometry.attributes[name];
      if (!column) continue;
      column.array.set(values);
      if (values.length < size * grains) column.array.fill(NaN, values.length, size * grains);
      column.clearUpdateRanges();
      column.addUpdateRange(0, size * grains);
      column.needsUpdate = true;
    }
    this.geometry.instanceCount = grains;
  }

  // Shaders that draw bodies, and the faces of a frame, which are those of all.
  drawBodies(frame) {
    const { planes } = this.material.uniforms;
    if (planes.value) return;
    planes.value = bodies.planes(frame);
    for (const material of [this.material, this.asked]) {
      material.defines.BODIES = "";
      material.needsUpdate = true;
    }
  }
}
