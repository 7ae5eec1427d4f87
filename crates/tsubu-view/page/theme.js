// Dark or light: as the system has it, until the user says otherwise.

export function set(theme, stage) {
  document.documentElement.dataset.theme = theme;
  const style = getComputedStyle(document.documentElement);
  stage.renderer.setClearColor(style.getPropertyValue("--back").trim());
  const ink = style.getPropertyValue("--ink").trim();
  for (const { walls, reference, outlines } of stage.panes) {
    for (const material of [walls.line, walls.face, reference.ink, outlines.material]) material.color.set(ink);
  }
  stage.draw();
}

export const preferred = () => (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
export const other = () => (document.documentElement.dataset.theme === "dark" ? "light" : "dark");
