// Grains as spheres: a square for each that faces the eye, on which a shader draws a sphere. In the plane they are discs.

import * as three from "./three.min.js";
import { texture } from "./palette.js";

const VERTEX = `
in vec3 centre; in float radius; in float colour;
uniform vec4 cut; uniform int picked; uniform float shrink;
out float marked; out vec3 middle; out vec3 place; out float size; out float shade;
void main() {
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
in float marked; in vec3 middle; in vec3 place; in float size; in float shade;
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
  vec4 clip = projectionMatrix * vec4(hit, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  float t = range.y > range.x ? (shade - range.x) / (range.y - range.x) : 0.35;
  // Half a texel from the ends, so that the ends have their own colours.
  vec3 paint = shade == shade ? texture(palette, vec2(clamp(t, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb : missing;
  float facing = max(dot(normal, -along), 0.0);
  float light = flatland ? (facing < 0.3 ? 0.6 : 1.0) : 0.3 + 0.7 * facing;
  seen = marked > 0.5 && facing < 0.6 ? vec4(0.98, 0.45, 0.05, 1.0) : vec4(paint * light, 1.0);
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
    };
    this.material = new three.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, glslVersion: three.GLSL3 });
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
  show({ grains, position, radius, colour }) {
    if (grains > this.capacity) {
      this.capacity = Math.ceil(1.2 * grains);
      this.geometry.dispose();
      for (const [name, size] of [["centre", 3], ["radius", 1], ["colour", 1]]) {
        const column = new three.InstancedBufferAttribute(new Float32Array(size * this.capacity), size);
        this.geometry.setAttribute(name, column.setUsage(three.DynamicDrawUsage));
      }
    }
    const fill = (name, values) => {
      const column = this.geometry.attributes[name];
      if (!column) return;
      column.array.set(values);
      if (values.length < column.itemSize * grains) column.array.fill(NaN, values.length, column.itemSize * grains);
      column.clearUpdateRanges();
      column.addUpdateRange(0, column.itemSize * grains);
      column.needsUpdate = true;
    };
    fill("centre", position);
    fill("radius", radius);
    fill("colour", colour);
    this.geometry.instanceCount = grains;
  }
}
