// Vectors of grains as arrows from their middles: the longest is as long as some grains are wide.

import * as three from "./three.min.js";

const VERTEX = `
in vec3 from; in vec3 arrow;
uniform float stretch; uniform float thickness; uniform vec4 cut;
void main() {
  vec3 axis = stretch * arrow;
  float size = length(axis);
  vec3 along = axis / max(size, 1e-30);
  vec3 side = normalize(cross(along, abs(along.z) > 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 0.0, 1.0)));
  vec3 other = cross(along, side);
  // z from 0 to 1 is the shaft, to 2 the head, which is no longer than the arrow.
  float head = min(4.0 * thickness, size);
  float reach = position.z <= 1.0 ? position.z * (size - head) : size - head + (position.z - 1.0) * head;
  float wide = thickness * min(1.0, size / (4.0 * thickness));
  vec3 corner = from + reach * along + wide * (position.x * side + position.y * other);
  bool away = dot(cut.xyz, from) > cut.w || !(size > 0.0);
  gl_Position = away ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * modelViewMatrix * vec4(corner, 1.0);
}`;

const FRAGMENT = `
uniform vec3 ink; out vec4 seen;
void main() { seen = vec4(ink, 1.0); }`;

// A shaft of four sides and a head of six.
function shape() {
  const corners = [];
  const at = (k, sides, wide, z) => [wide * Math.cos((2 * k * Math.PI) / sides), wide * Math.sin((2 * k * Math.PI) / sides), z];
  for (let k = 0; k < 4; k++) {
    const [a, b] = [k, k + 1];
    corners.push(...at(a, 4, 0.5, 0), ...at(b, 4, 0.5, 0), ...at(b, 4, 0.5, 1), ...at(a, 4, 0.5, 0), ...at(b, 4, 0.5, 1), ...at(a, 4, 0.5, 1));
  }
  for (let k = 0; k < 6; k++) corners.push(...at(k, 6, 1.6, 1.001), ...at(k + 1, 6, 1.6, 1.001), 0, 0, 2);
  return new Float32Array(corners);
}

export class Arrows {
  constructor() {
    this.geometry = new three.InstancedBufferGeometry();
    this.geometry.setAttribute("position", new three.BufferAttribute(shape(), 3));
    this.material = new three.ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, glslVersion: three.GLSL3, side: three.DoubleSide, depthTest: false,
      uniforms: {
        stretch: { value: 1 }, thickness: { value: 1 }, cut: { value: new three.Vector4(0, 0, 0, 1) }, ink: { value: new three.Color(0xd92d20) },
      },
    });
    this.mesh = new three.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
    this.mesh.visible = false;
  }

  // Shows the arrows of a frame; `longest` is the size of the vector whose arrow is six grains long.
  show({ position, radius, arrows }, longest) {
    this.mesh.visible = Boolean(arrows?.length) && longest > 0;
    if (!this.mesh.visible) return;
    this.geometry.dispose();
    this.geometry.setAttribute("from", new three.InstancedBufferAttribute(position, 3));
    this.geometry.setAttribute("arrow", new three.InstancedBufferAttribute(arrows, 3));
    this.geometry.instanceCount = radius.length;
    const mean = radius.reduce((a, b) => a + b, 0) / radius.length;
    this.material.uniforms.stretch.value = (6 * mean) / longest;
    this.material.uniforms.thickness.value = 0.2 * mean;
  }
}

// The size of the largest vector.
export function longest({ arrows }) {
  let most = 0;
  for (let i = 0; i + 2 < (arrows?.length ?? 0); i += 3) {
    const size = Math.hypot(arrows[i], arrows[i + 1], arrows[i + 2]);
    if (size > most) most = size;
  }
  return most;
}
