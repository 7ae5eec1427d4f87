// The one camera of all panes: it turns in space, and looks along y on what lies in the plane.

import * as three from "./three.min.js";

export class View {
  constructor(canvas, flat, changed) {
    this.flat = flat;
    this.camera = flat ? new three.OrthographicCamera() : new three.PerspectiveCamera(35);
    this.camera.up.set(0, 0, 1);
    this.controls = new three.OrbitControls(this.camera, canvas);
    this.controls.enableRotate = !flat;
    this.controls.zoomToCursor = true;
    if (flat) {
      this.controls.mouseButtons.LEFT = three.MOUSE.PAN;
      this.controls.touches.ONE = three.TOUCH.PAN;
    }
    this.controls.addEventListener("change", changed);
    // Who has moved the camera keeps it.
    this.moved = false;
    this.controls.addEventListener("start", () => (this.moved = true));
    this.aspect = 1;
  }

  // Width over height of a pane.
  shape(aspect) {
    // A page that is not laid out yet has no shape.
    this.aspect = aspect > 0 && Number.isFinite(aspect) ? aspect : 1;
    if (this.whole && !this.moved) this.fit(this.whole);
    else this.project();
  }

  project() {
    const { aspect } = this;
    if (this.flat) {
      const half = this.half ?? 1;
      Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    } else {
      this.camera.aspect = aspect;
    }
    this.camera.updateProjectionMatrix();
  }

  // Shows all of a box.
  fit(box) {
    this.moved = false;
    if (box.isEmpty()) return;
    this.whole = box;
    const middle = box.getCenter(new three.Vector3());
    const size = box.getSize(new three.Vector3());
    const reach = Math.max(size.length() / 2, 1e-9);
    this.controls.target.copy(middle);
    if (this.flat) {
      this.half = 0.56 * Math.max(size.z, size.x / this.aspect, 1e-9);
      this.camera.zoom = 1;
      this.camera.position.set(middle.x, middle.y - 4 * reach, middle.z);
      Object.assign(this.camera, { near: 0.01 * reach, far: 8 * reach });
    } else {
      const angle = (this.camera.fov * Math.PI) / 360;
      const far = (1.02 * reach) / Math.sin(Math.atan(Math.tan(angle) * Math.min(1, this.aspect)));
      this.camera.position.copy(middle).addScaledVector(new three.Vector3(0.45, -0.85, 0.28).normalize(), far);
      Object.assign(this.camera, { near: 0.002 * reach, far: 40 * reach });
    }
    this.project();
    this.controls.update();
  }

  // How many metres a pixel is, at the middle of what is looked at.
  metresPerPixel(height) {
    if (this.flat) return (2 * this.half) / this.camera.zoom / height;
    const far = this.camera.position.distanceTo(this.controls.target);
    return (2 * far * Math.tan((this.camera.fov * Math.PI) / 360)) / height;
  }
}
