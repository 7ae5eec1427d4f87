// The canvas with all panes, side by side. It is drawn again when something has changed, and not before.

import * as three from "./three.min.js";

three.ColorManagement.enabled = false;

export class Stage {
  constructor(canvas, panes) {
    this.canvas = canvas;
    this.panes = panes;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true });
    this.renderer.outputColorSpace = three.LinearSRGBColorSpace;
    this.renderer.localClippingEnabled = true;
    this.renderer.autoClear = false;
    this.drawn = () => {};
    // Milliseconds that the last picture took outside of the graphics card.
    this.cost = 0;
    this.drawings = 0;
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  // Columns and rows of panes, as near to squares as it goes.
  grid() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const count = this.panes.length;
    const columns = Math.min(count, Math.max(1, Math.round(Math.sqrt((count * width) / Math.max(height, 1)))));
    const rows = Math.ceil(count / columns);
    return { columns, rows, width: width / columns, height: height / rows };
  }

  // Where a pane stands: left, top, width, height, in pixels of the page.
  place(number) {
    const { columns, width, height } = this.grid();
    return [(number % columns) * width, Math.floor(number / columns) * height, width, height];
  }

  resize() {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    const { width, height } = this.grid();
    this.view?.shape(width / Math.max(height, 1));
    this.panes.forEach((pane, number) => {
      const [left, top] = this.place(number);
      Object.assign(pane.label.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
      pane.label.style.borderWidth = this.panes.length > 1 ? "0 1px 1px 0" : "0";
    });
    this.draw();
  }

  // Asks for a picture; many wishes make one.
  draw() {
    this.wish ??= requestAnimationFrame(() => {
      this.wish = undefined;
      this.drawNow();
    });
  }

  drawNow() {
    if (!this.view) return;
    const began = performance.now();
    // When the first picture was ready to be drawn, in milliseconds since the page was asked for.
    this.first ??= began;
    const { renderer } = this;
    renderer.setScissorTest(false);
    renderer.clear();
    renderer.setScissorTest(true);
    this.panes.forEach((pane, number) => {
      const [left, top, width, height] = this.place(number);
      const bottom = this.canvas.clientHeight - top - height;
      renderer.setViewport(left, bottom, width, height);
      renderer.setScissor(left, bottom, width, height);
      renderer.render(pane.scene, this.view.camera);
      pane.letter(this.view.camera, width, height);
    });
    this.cost = performance.now() - began;
    this.drawings++;
    this.drawn();
  }
}
