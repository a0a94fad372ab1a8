// The clouds and the posed robot in WebGL 2. Everything is in the base frame, metres, z up.
(() => {
  "use strict";
  const byId = (id) => document.getElementById(id);
  const canvas = byId("view");
  // Kept, so that the view can be printed.
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) {
    byId("no-view").hidden = false;
    byId("controls").hidden = canvas.hidden = true;
    return;
  }
  const scene = JSON.parse(byId("scene-data").textContent);

  // -- data
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const words = (text) => new Uint16Array(bytes(text).buffer);
  const buffer = (data, target = gl.ARRAY_BUFFER) => {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return made;
  };
  const points = (text, stride = 3) => ({ buffer: buffer(words(text)), type: gl.UNSIGNED_SHORT, normalized: true, size: stride });
  const attribute = (place, { buffer, type, normalized, size }) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
  };
  const array = (fill) => {
    const made = gl.createVertexArray();
    gl.bindVertexArray(made);
    fill();
    gl.bindVertexArray(null);
    return made;
  };
  // Matrices are columns of four, as WebGL wants them; those of the scene are three rows.
  const matrix = (rows) => [0, 1, 2, 3].flatMap((c) => [rows[c], rows[4 + c], rows[8 + c], c === 3 ? 1 : 0]);
  const times = (a, b) => Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[k * 4 + (i % 4)] * b[(i >> 2) * 4 + k], 0));
  const box = ({ low, size }) => [size[0], 0, 0, 0, 0, size[1], 0, 0, 0, 0, size[2], 0, ...low, 1];
  const identity = box({ low: [0, 0, 0], size: [1, 1, 1] });

  const clouds = scene.configurations.map((c) => ({
    count: c.count,
    links: c.links.map(matrix),
    vertices: array(() => {
      attribute(0, points(c.points));
      attribute(1, { buffer: buffer(bytes(c.labels)), type: gl.UNSIGNED_BYTE, normalized: false, size: 1 });
      attribute(2, { buffer: buffer(new Int8Array(bytes(c.behind_mm).buffer)), type: gl.BYTE, normalized: false, size: 1 });
    }),
  }));
  const shapes = scene.links.map((link) => {
    const indices = link.wide ? new Uint32Array(bytes(link.triangles).buffer) : words(link.triangles);
    return {
      box: box(link.bounds),
      count: indices.length,
      type: link.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT,
      vertices: array(() => {
        attribute(0, points(link.vertices));
        buffer(indices, gl.ELEMENT_ARRAY_BUFFER);
      }),
    };
  });

  // -- programs
  const program = (vertex, fragment) => {
    const made = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${text}`);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    return { made, at: (name) => gl.getUniformLocation(made, name) };
  };
  const cloudProgram = program(
    `layout(location = 0) in vec3 place; layout(location = 1) in float label; layout(location = 2) in float mm;
     uniform mat4 toClip; uniform float size; uniform bool byDistance; uniform vec3 rest, arm, unsure, even;
     out vec3 color;
     void main() {
       gl_Position = toClip * vec4(place, 1.0);
       gl_PointSize = label == 0.0 ? size : size * 1.2;
       float t = clamp(mm / 25.0, -1.0, 1.0);
       vec3 end = t < 0.0 ? vec3(0.08, 0.24, 1.0) : vec3(1.0, 0.12, 0.04);
       vec3 distance = mm < -127.5 ? rest : mix(even, end, abs(t));
       color = byDistance ? distance : label == 0.0 ? rest : label == 1.0 ? arm : unsure;
     }`,
    `in vec3 color; out vec4 pixel; void main() { pixel = vec4(color, 1.0); }`);
  const shapeProgram = program(
    `layout(location = 0) in vec3 place; uniform mat4 toWorld, toClip; out vec3 world;
     void main() { vec4 p = toWorld * vec4(place, 1.0); world = p.xyz; gl_Position = toClip * p; }`,
    `in vec3 world; uniform vec3 eye, tint; uniform float opacity; out vec4 pixel;
     void main() {
       vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
       float light = 0.45 + 0.55 * abs(dot(normal, normalize(eye - world)));
       pixel = vec4(tint * light, 1.0) * opacity;
     }`);
  const lineProgram = program(
    `layout(location = 0) in vec3 place; layout(location = 1) in vec3 tint; uniform mat4 toClip; out vec3 color;
     void main() { gl_Position = toClip * vec4(place, 1.0); color = tint; }`,
    `in vec3 color; out vec4 pixel; void main() { pixel = vec4(color, 1.0); }`);

  // -- colours of the page
  const style = (name) => {
    const hex = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    const full = hex.length === 4 ? hex.replace(/[^#]/g, "$&$&") : hex;
    return [1, 3, 5].map((at) => parseInt(full.slice(at, at + 2), 16) / 255);
  };

  // -- lines: the base's plane and axes, the camera's axes and what it sees
  const transformed = (m, [x, y, z]) => [0, 1, 2].map((r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r]);
  const camera = matrix(scene.camera.base_from_camera);
  const image = matrix(scene.camera.base_from_image);
  const eyeOfCamera = camera.slice(12, 15);
  const reach = Math.hypot(...eyeOfCamera);
  let lines = [];
  const buildLines = () => {
    const parts = { ground: [], frustum: [], axes: [], eye: [] };
    const add = (part, color, ...places) => places.forEach((place) => parts[part].push(...place, ...color));
    for (let i = -6; i <= 6; i++) {
      add("ground", style("rule"), [i / 4, -1.5, 0], [i / 4, 1.5, 0], [-1.5, i / 4, 0], [1.5, i / 4, 0]);
    }
    const axes = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
    for (const [name, axis] of axes) {
      const along = (length) => axis.map((a) => a * length);
      add("axes", style(name), [0, 0, 0], along(0.3));
      add("eye", style(name), eyeOfCamera, transformed(camera, along(0.2)));
    }
    const corners = scene.camera.corners.map(([x, y]) => transformed(image, [x * 0.35 * reach, y * 0.35 * reach, 0.35 * reach]));
    corners.forEach((corner, i) => add("frustum", style("soft"), eyeOfCamera, corner, corner, corners[(i + 1) % 4]));
    lines = Object.entries(parts).map(([name, data]) => ({
      name,
      count: data.length / 6,
      vertices: array(() => {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer(new Float32Array(data)));
        for (const place of [0, 1]) {
          gl.enableVertexAttribArray(place);
          gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 24, 12 * place);
        }
      }),
    }));
  };

  // -- what is shown
  const shown = new Set([Math.max(0, scene.configurations.findIndex((c) => !c.dropped))]);
  scene.configurations.forEach((configuration, index) => {
    const [label, input] = [document.createElement("label"), document.createElement("input")];
    Object.assign(input, { type: "checkbox", checked: shown.has(index) });
    input.addEventListener("change", () => { shown[input.checked ? "add" : "delete"](index); redraw(); });
    label.append(input, ` ${configuration.name}${configuration.dropped ? " (dropped)" : ""}`);
    byId("shown").append(label);
  });
  byId("controls").addEventListener("change", () => redraw());
  const names = [
    [scene.names.base, "frame", [0, 0, 0]], ["x", "x", [0.32, 0, 0]], ["y", "y", [0, 0.32, 0]], ["z", "z", [0, 0, 0.34]],
    [scene.names.camera, "frame", eyeOfCamera, "frustum"],
    ...["x", "y", "z"].map((name, i) => [name, name, transformed(camera, [0, 1, 2].map((j) => (i === j ? 0.22 : 0))), "frustum"]),
  ].map(([text, kind, place, needs]) => {
    const element = document.createElement("span");
    element.className = kind;
    element.textContent = text;
    byId("labels").append(element);
    return { element, place, needs };
  });

  // -- where it is looked at from
  const target = scene.target.map((middle) => 0.6 * middle);
  const from = Math.atan2(eyeOfCamera[1] - target[1], eyeOfCamera[0] - target[0]);
  const home = () => ({ turn: from + 0.55, lift: 0.4, away: 1.45 * Math.max(reach, 0.6), target: [...target] });
  let look = home();
  const spin = () => {
    const [ct, st, cl, sl] = [Math.cos(look.turn), Math.sin(look.turn), Math.cos(look.lift), Math.sin(look.lift)];
    return { right: [-st, ct, 0], up: [-ct * sl, -st * sl, cl], back: [ct * cl, st * cl, sl] };
  };
  const projection = (aspect) => {
    const { right, up, back } = spin();
    const eye = look.target.map((t, i) => t + look.away * back[i]);
    const along = (axis) => -axis.reduce((sum, a, i) => sum + a * eye[i], 0);
    const view = [0, 1, 2].flatMap((i) => [right[i], up[i], back[i], 0]).concat([along(right), along(up), along(back), 1]);
    // A narrow window sees as much to the sides as a wide one.
    const f = 2.2 * Math.min(1, aspect / 1.3), [near, far] = [0.02 * look.away, 20 * look.away + 10];
    const lens = [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
    return { eye, toClip: times(lens, view) };
  };

  // -- drawing
  const drawClouds = (toClip, scale) => {
    gl.useProgram(cloudProgram.made);
    gl.uniformMatrix4fv(cloudProgram.at("toClip"), false, times(toClip, box(scene.bounds)));
    gl.uniform1f(cloudProgram.at("size"), 2 * scale);
    gl.uniform1i(cloudProgram.at("byDistance"), byId("controls").elements.colour.value === "distance");
    for (const name of ["rest", "arm", "unsure"]) gl.uniform3fv(cloudProgram.at(name), style(name));
    gl.uniform3fv(cloudProgram.at("even"), [0.85, 0.85, 0.85]);
    for (const index of shown) {
      gl.bindVertexArray(clouds[index].vertices);
      gl.drawArrays(gl.POINTS, 0, clouds[index].count);
    }
  };
  const drawRobot = (toClip, eye, through) => {
    gl.useProgram(shapeProgram.made);
    gl.uniformMatrix4fv(shapeProgram.at("toClip"), false, toClip);
    gl.uniform3fv(shapeProgram.at("eye"), eye);
    gl.uniform3fv(shapeProgram.at("tint"), style("shade"));
    gl.uniform1f(shapeProgram.at("opacity"), through ? 0.45 : 1);
    for (const index of shown) {
      shapes.forEach((shape, link) => {
        gl.uniformMatrix4fv(shapeProgram.at("toWorld"), false, times(clouds[index].links[link], shape.box));
        gl.bindVertexArray(shape.vertices);
        gl.drawElements(gl.TRIANGLES, shape.count, shape.type, 0);
      });
    }
  };
  const placeNames = (toClip, frustum) => {
    for (const { element, place, needs } of names) {
      const [x, y, , w] = [0, 1, 2, 3].map((r) => place.reduce((sum, p, i) => sum + toClip[4 * i + r] * p, toClip[12 + r]));
      element.hidden = w <= 0 || Math.abs(x) > w || Math.abs(y) > w || (needs === "frustum" && !frustum);
      element.style.left = `${50 + (50 * x) / w}%`;
      element.style.top = `${50 - (50 * y) / w}%`;
    }
    // Of names that would lie on each other the first is shown.
    const taken = [];
    for (const { element } of names) {
      if (element.hidden) continue;
      const own = element.getBoundingClientRect();
      const lies = (other) => own.left < other.right && other.left < own.right && own.top < other.bottom && other.top < own.bottom;
      element.style.visibility = taken.some(lies) ? "hidden" : "visible";
      if (element.style.visibility === "visible") taken.push(own);
    }
  };
  const draw = () => {
    const scale = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((n) => Math.max(1, Math.round(n * scale)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(...style("stage"), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    const { eye, toClip } = projection(width / height);
    const frustum = byId("frustum").checked;
    drawClouds(toClip, scale);
    if (byId("robot").checked) {
      const through = byId("through").checked;
      if (through) {
        // Depth alone first: of surfaces one behind the other only the nearest is blended.
        gl.colorMask(false, false, false, false);
        drawRobot(toClip, eye, through);
        gl.colorMask(true, true, true, true);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      }
      drawRobot(toClip, eye, through);
      gl.disable(gl.BLEND);
    }
    gl.useProgram(lineProgram.made);
    gl.uniformMatrix4fv(lineProgram.at("toClip"), false, toClip);
    for (const { name, vertices, count } of lines) {
      if (name !== "ground" && name !== "axes" && !frustum) continue;
      // Axes show through what they stand in.
      gl.depthFunc(name === "ground" || name === "frustum" ? gl.LEQUAL : gl.ALWAYS);
      gl.bindVertexArray(vertices);
      gl.drawArrays(gl.LINES, 0, count);
    }
    gl.depthFunc(gl.LEQUAL);
    placeNames(toClip, frustum);
    const byDistance = byId("controls").elements.colour.value === "distance";
    byId("by-distance").hidden = !byDistance;
    byId("by-label").hidden = byDistance;
  };
  let asked = false;
  const redraw = () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; draw(); });
  };

  // -- mouse, fingers, keys
  const turn = (dx, dy) => {
    look.turn -= 0.008 * dx;
    look.lift = Math.min(1.55, Math.max(-1.55, look.lift + 0.008 * dy));
  };
  const move = (dx, dy) => {
    const { right, up } = spin();
    const step = (0.9 * look.away) / canvas.clientHeight;
    look.target = look.target.map((t, i) => t + step * (dy * up[i] - dx * right[i]));
  };
  const zoom = (factor) => { look.away = Math.min(20, Math.max(0.1, look.away * factor)); };
  const fingers = new Map();
  const apart = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    const before = fingers.size === 2 ? apart() : 0;
    Object.assign(last, { x: event.clientX, y: event.clientY });
    if (fingers.size === 2) {
      zoom(before / Math.max(1, apart()));
      move(dx / 2, dy / 2);
    } else if (event.buttons & 6 || event.shiftKey) {
      move(dx, dy);
    } else {
      turn(dx, dy);
    }
    redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  // The wheel scrolls the page; with ctrl, which browsers also tell of a pinch on a touchpad, it zooms.
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    zoom(Math.exp(0.0012 * event.deltaY * (event.deltaMode ? 30 : 1)));
    redraw();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { look = home(); redraw(); });
  const keys = {
    ArrowLeft: () => turn(-20, 0), ArrowRight: () => turn(20, 0), ArrowUp: () => turn(0, 20), ArrowDown: () => turn(0, -20),
    "+": () => zoom(0.9), "=": () => zoom(0.9), "-": () => zoom(1.1), 0: () => { look = home(); },
  };
  canvas.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    act();
    redraw();
  });
  canvas.addEventListener("webglcontextlost", () => { byId("no-view").hidden = false; });
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { buildLines(); redraw(); });
  buildLines();
  draw();
})();
