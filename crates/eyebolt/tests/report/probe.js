// After everything of the page: does what a person would do, and tells what came of it.
(async () => {
  const canvas = document.getElementById("view");
  const gl = canvas.getContext("webgl2");
  const settled = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const picture = () => {
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return new Uint32Array(pixels.buffer);
  };
  const different = (a, b) => a.reduce((sum, pixel, at) => sum + (pixel !== b[at]), 0) / a.length;
  // A made-up pointer cannot be captured.
  canvas.setPointerCapture = () => {};
  const pointer = (type, x, y, buttons, pointerId = 1) =>
    canvas.dispatchEvent(new PointerEvent(type, { pointerId, clientX: x, clientY: y, buttons, bubbles: true }));
  const after = async (act) => {
    const before = picture();
    act();
    await settled();
    return different(before, picture());
  };
  const click = (selector) => () => document.querySelector(selector).click();
  await settled();
  const first = picture();
  const found = { drawn: different(first, first.map(() => first[0])) };
  found.drag = await after(() => {
    pointer("pointerdown", 300, 300, 1);
    pointer("pointermove", 380, 330, 1);
    pointer("pointerup", 380, 330, 0);
  });
  found.hover = await after(() => pointer("pointermove", 100, 100, 0));
  let scrolls = false;
  found.scroll = await after(() => { scrolls = canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -300, cancelable: true })); });
  found.wheel_scrolls = scrolls;
  found.wheel = await after(() => canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -300, cancelable: true, ctrlKey: true })));
  found.touch = getComputedStyle(canvas).touchAction;
  found.pinch = await after(() => {
    pointer("pointerdown", 300, 300, 1, 1);
    pointer("pointerdown", 400, 300, 1, 2);
    pointer("pointermove", 460, 300, 1, 2);
    pointer("pointerup", 300, 300, 0, 1);
    pointer("pointerup", 460, 300, 0, 2);
  });
  found.key = await after(() => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" })));
  canvas.dispatchEvent(new MouseEvent("dblclick"));
  await settled();
  found.reset = different(first, picture());
  found.colour = await after(click("input[value=distance]"));
  found.robot = await after(click("#robot"));
  found.camera = await after(click("#frustum"));
  found.configuration = await after(click("#shown label:nth-of-type(2) input"));
  found.configurations = document.querySelectorAll("#shown input").length;
  found.names = [...document.querySelectorAll("#labels span")].map((span) => span.textContent);
  const plots = [...document.querySelectorAll("svg.plot")];
  found.marks = Object.fromEntries(plots.map((plot) => [plot.dataset.plot, plot.querySelectorAll("g.mark").length]));
  found.pictures = [...document.images].map((image) => image.complete && image.naturalWidth > 0);
  found.requests = performance.getEntriesByType("resource").map((entry) => entry.name).filter((name) => !name.startsWith("data:"));
  found.problems = window.problems;
  const told = document.createElement("pre");
  told.id = "found";
  told.textContent = JSON.stringify(found);
  document.body.append(told);
})();
