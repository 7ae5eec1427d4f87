export {
  BufferAttribute, BufferGeometry, Box3, Color, ColorManagement, DataTexture, DoubleSide, DynamicDrawUsage, FloatType, GLSL3, Group,
  InstancedBufferAttribute, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, LinearFilter,
  LinearSRGBColorSpace, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MOUSE, OrthographicCamera, PerspectiveCamera, Plane,
  RGBAFormat, Scene, ShaderMaterial, TOUCH, Vector2, Vector3, Vector4, WebGLRenderer, WebGLRenderTarget,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
