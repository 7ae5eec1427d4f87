// Contacts as bonds: rods from middle to middle, as thick as the force is large against the largest of the frame.

import * as three from "./three.min.js";

const VERTEX = `
in vec3 from; in vec3 to; in float strength;
uniform float thickness; uniform vec4 cut;
out float force;
void main() {
  vec3 axis = to - from;
  vec3 side = normalize(cross(axis, abs(axis.z) > 0.9 * length(axis) ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 0.0, 1.0)));
  vec3 other = normalize(cross(axis, side));
  float width = thickness * sqrt(strength);
  vec3 corner = from + position.z * axis + width * (position.x * side + position.y * other);
  force = strength;
  bool away = dot(cut.xyz, 0.5 * (from + to)) > cut.w;
  gl_Position = away ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * modelViewMatrix * vec4(corner, 1.0);
}`;

const FRAGMENT = `
in float force; out vec4 seen;
void main() { seen = vec4(mix(vec3(0.98, 0.75, 0.45), vec3(0.73, 0.1, 0.1), force), 1.0); }`;

// A rod of six sides along z, from 0 to 1.
function rod() {
  const corners = [];
  const at = (k, z) => [Math.cos((k * Math.PI) / 3), Math.sin((k * Math.PI) / 3), z];
  for (let k = 0; k < 6; k++) corners.push(...at(k, 0), ...at(k + 1, 0), ...at(k + 1, 1), ...at(k, 0), ...at(k + 1, 1), ...at(k, 1));
  return new Float32Array(corners);
}

export class Bonds {
  constructor() {
    this.geometry = new three.InstancedBufferGeometry();
    this.geometry.setAttribute("position", new three.BufferAttribute(rod(), 3));
    this.material = new three.ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, glslVersion: three.GLSL3, side: three.DoubleSide,
      uniforms: { thickness: { value: 1 }, cut: { value: new three.Vector4(0, 0, 0, 1) } },
    });
    this.mesh = new three.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  // Whether they are drawn over the grains, as in the plane.
  lieOn(flat) {
    this.material.depthTest = !flat;
    this.mesh.renderOrder = flat ? 1 : 0;
  }

  show({ bonds, forces, radius }) {
    const largest = forces.reduce((a, b) => Math.max(a, b), 0);
    this.geometry.dispose();
    const ends = new three.InstancedInterleavedBuffer(bonds, 6);
    this.geometry.setAttribute("from", new three.InterleavedBufferAttribute(ends, 3, 0));
    this.geometry.setAttribute("to", new three.InterleavedBufferAttribute(ends, 3, 3));
    const strength = forces.map((force) => (largest > 0 ? force / largest : 0));
    this.geometry.setAttribute("strength", new three.InstancedBufferAttribute(strength, 1));
    this.geometry.instanceCount = forces.length;
    this.material.uniforms.thickness.value = 0.4 * (radius[0] ?? 1);
  }
}
