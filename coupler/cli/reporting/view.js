// SPDX-License-Identifier: GPL-3.0-or-later
// The report's 3D view, one for each <figure class="view">, with three.js. What it shows is made by view.py and stands
// in the figure as JSON: numbers of 16 and 8 bits, base64, over the box and its longest side.
"use strict";

(function () {
  const WATER = 0x2f86c9;
  const DIRECTIONS = {oblique: [0.55, -1, 0.45], front: [0, -1, 0], side: [1, 0, 0], top: [0, -0.0001, 1]};

  // A disc towards the reader that has the depth and the shade of a sphere: exact, and two triangles a particle.
  const SPHERES = {
    vertexShader: `
      attribute vec3 centre;
      attribute float radius;
      attribute vec3 colour;
      uniform float least;
      varying vec2 at;
      varying vec3 tint;
      varying float deep;
      void main() {
        at = position.xy;
        tint = colour;
        float drawn = max(radius, least);
        deep = 0.5 * projectionMatrix[2][2] * drawn;
        gl_Position = projectionMatrix * (modelViewMatrix * vec4(centre, 1.0) + vec4(position.xy * drawn, 0.0, 0.0));
      }`,
    fragmentShader: `
      varying vec2 at;
      varying vec3 tint;
      varying float deep;
      void main() {
        float away = dot(at, at);
        if (away > 1.0) discard;
        float near = sqrt(1.0 - away);
        gl_FragDepthEXT = gl_FragCoord.z + deep * near;
        float light = 0.55 + 0.45 * max(0.0, dot(vec3(at, near), normalize(vec3(-0.4, 0.6, 0.8))));
        gl_FragColor = vec4(tint * light, 1.0);
      }`,
    extensions: {fragDepth: true}
  };

  function numbers(text, Type) {
    const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
    return new Type(bytes.buffer);
  }

  function element(name, parent, properties, text) {
    const made = Object.assign(document.createElement(name), properties || {});
    if (text) made.textContent = text;
    parent.append(made);
    return made;
  }

  function short(value) {
    return String(Number(value.toPrecision(3)));
  }

  class View {
    constructor(figure) {
      this.figure = figure;
      this.data = JSON.parse(figure.querySelector("script").textContent);
      this.size = Math.max(...[0, 1, 2].map(i => this.data.upper[i] - this.data.lower[i]));
      this.centre = [0, 1, 2].map(i => 0.5 * (this.data.lower[i] + this.data.upper[i]));
      this.stage = element("div", figure, {className: "stage"});
      const canvas = element("canvas", this.stage);
      const context = canvas.getContext("webgl2", {antialias: true});
      if (!context) {
        this.stage.remove();
        element("p", figure, {className: "quiet"}, "The view needs WebGL 2, which this browser does not offer.");
        return;
      }
      this.renderer = new THREE.WebGLRenderer({canvas, context});
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
      this.scene = new THREE.Scene();
      this.layers = {};
      this.setCamera(canvas);
      this.labels = [0, 1, 2].map(() => [0, 1, 2].map(() => element("span", this.stage, {className: "label"})));
      this.setControls();
      this.show(this.data.times.length - 1);
      this.resize();
      this.look("oblique");
      new ResizeObserver(() => this.resize()).observe(this.stage);
      window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.show(this.shown));
    }

    // The reader's side is the lower end of the axis across; "up" is against gravity.
    setCamera(canvas) {
      const [vertical, sign] = this.data.vertical;
      this.up = new THREE.Vector3().setComponent(vertical, sign);
      const right = new THREE.Vector3().setComponent(vertical === 0 ? 1 : 0, 1);
      this.axes = [right, new THREE.Vector3().crossVectors(this.up, right), this.up];
      this.reach = 0.5 * Math.hypot(...[0, 1, 2].map(i => this.data.upper[i] - this.data.lower[i])) / this.size;
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1 * this.reach, 20 * this.reach);
      this.camera.up.copy(this.up);
      const lamp = new THREE.DirectionalLight(0xffffff, 0.6);
      lamp.position.set(-0.4, 0.6, 0.8);
      this.camera.add(lamp);
      this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.55));
      this.controls = new THREE.OrbitControls(this.camera, canvas);
      this.controls.enableKeys = false; // they are the page's
      this.controls.screenSpacePanning = true;
      // Before it was touched, the wheel moves the page.
      this.controls.enableZoom = false;
      canvas.addEventListener("pointerdown", () => { this.controls.enableZoom = true; });
      canvas.addEventListener("pointerleave", () => { this.controls.enableZoom = false; });
      this.controls.addEventListener("change", () => this.draw());
    }

    setControls() {
      const last = this.data.times.length - 1;
      const bar = element("div", this.figure, {className: "controls"});
      const times = element("span", bar, {className: "group"});
      const step = by => this.show(Math.min(last, Math.max(0, this.shown + by)));
      element("button", times, {type: "button", title: "one time back", onclick: () => step(-1)}, "\u25c0");
      this.slider = element("input", times, {type: "range", min: 0, max: last, step: 1});
      this.slider.setAttribute("aria-label", "time");
      this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
      element("button", times, {type: "button", title: "one time on", onclick: () => step(1)}, "\u25b6");
      this.clock = element("output", times);

      const views = element("span", bar, {className: "group"});
      for (const name of Object.keys(DIRECTIONS))
        element("button", views, {type: "button", onclick: () => this.look(name)}, name);
      for (const [sign, factor] of [["+", 1.25], ["\u2212", 0.8]])
        element("button", views, {type: "button", title: factor > 1 ? "nearer" : "farther",
                                  onclick: () => this.zoom(this.camera.zoom * factor)}, sign);

      this.boxes = {};
      const shown = element("span", bar, {className: "group"});
      for (const [name, title] of [["surface", "surface"], ["wetted", "wetted walls"],
                                   ["particles", "particles"], ["walls", "surfaces of the script"]]) {
        if (!this.data.times.some(moment => moment[name] !== null)) continue;
        const label = element("label", shown);
        this.boxes[name] = element("input", label, {type: "checkbox", checked: true, onchange: () => this.draw()});
        label.append(" " + title);
      }
      if (this.data.fastest !== null) {
        const legend = element("div", this.stage, {className: "colours"});
        element("span", legend, {}, this.data.fastest > 0 ? "speed of particles" : "particles at rest");
        if (this.data.fastest > 0) this.bar(legend);
      }
      this.note = element("p", this.figure, {className: "quiet"});
    }

    bar(legend) {
      element("span", legend, {}, "0");
      const bar = element("canvas", legend, {width: 256, height: 1});
      const pixels = Uint8ClampedArray.from({length: 1024}, (_, i) => i % 4 === 3 ? 255 : this.palette[3 * (i >> 2) + i % 4]);
      bar.getContext("2d").putImageData(new ImageData(pixels, 256, 1), 0, 0);
      element("span", legend, {}, `${short(this.data.fastest)} m/s`);
    }

    get palette() {
      return this.colours || (this.colours = numbers(this.data.colours, Uint8Array));
    }

    look(name) {
      const [right, back, up] = DIRECTIONS[name];
      this.camera.position.set(0, 0, 0).addScaledVector(this.axes[0], right).addScaledVector(this.axes[1], back)
        .addScaledVector(this.axes[2], up).setLength(5 * this.reach);
      this.controls.target.set(0, 0, 0);
      this.controls.update();
      this.camera.updateMatrixWorld();
      // The box fills what its labels leave: of each half, 1 less so many px.
      const room = [1 - 120 / this.stage.clientWidth, 1 - 80 / this.stage.clientHeight];
      this.zoom(this.camera.zoom * Math.min(...this.corners().flatMap(place => room.map((r, i) => r / Math.abs(place[i])))));
    }

    zoom(zoom) {
      this.camera.zoom = zoom;
      this.camera.updateProjectionMatrix();
      this.draw();
    }

    resize() {
      const width = this.stage.clientWidth, height = this.stage.clientHeight;
      if (!width) return;
      const half = this.reach, aspect = width / height;
      this.renderer.setSize(width, height, false);
      Object.assign(this.camera, {left: -half * Math.max(1, aspect), right: half * Math.max(1, aspect),
                                  top: half * Math.max(1, 1 / aspect), bottom: -half * Math.max(1, 1 / aspect)});
      this.camera.updateProjectionMatrix();
      this.draw();
    }

    // Of the box, upper ends of axis i where bit i is set, in the picture: -1 to 1 from left to right and bottom to top.
    corners() {
      return Array.from({length: 8}, (_, bits) => {
        const corner = [0, 1, 2].map(i => ((bits >> i & 1) - 0.5) * (this.data.upper[i] - this.data.lower[i]) / this.size);
        const point = new THREE.Vector3(...corner).project(this.camera);
        return [point.x, point.y];
      });
    }

    // ---------------------------------------------------------------------------------------- what is there at a time
    points(text) {
      const whole = numbers(text, Uint16Array), points = new Float32Array(whole.length);
      for (let i = 0; i < whole.length; ++i)
        points[i] = whole[i] / 65535 + (this.data.lower[i % 3] - this.centre[i % 3]) / this.size;
      return new THREE.BufferAttribute(points, 3);
    }

    show(index) {
      this.shown = index;
      this.slider.value = index;
      const moment = this.data.times[index];
      this.clock.textContent = `t = ${Number(moment.time.toPrecision(4))} s`;
      this.note.textContent = moment.note;
      for (const objects of Object.values(this.layers))
        for (const object of objects) {
          this.scene.remove(object);
          object.geometry.dispose();
          object.material.dispose();
        }
      const style = getComputedStyle(this.figure);
      this.scene.background = new THREE.Color(style.getPropertyValue("--stage").trim());
      const grey = style.getPropertyValue("--edge").trim(), shapes = this.data.shapes;
      this.layers = {edges: [this.edges(shapes[moment.edges], grey)]};
      if (moment.walls !== null) this.layers.walls = [this.walls(shapes[moment.walls], grey)];
      if (moment.particles) this.layers.particles = [this.spheres(moment.particles)];
      if (moment.surface) this.layers.surface = this.surface(moment.surface);
      if (moment.wetted) this.layers.wetted = [this.wetted(moment.wetted)];
      for (const objects of Object.values(this.layers)) this.scene.add(...objects);
      this.draw();
    }

    mesh(part) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", this.points(part.points));
      geometry.setIndex(new THREE.BufferAttribute(numbers(part.cells, Uint16Array), 1));
      return geometry;
    }

    edges(part, colour) {
      return new THREE.LineSegments(this.mesh(part), new THREE.LineBasicMaterial({color: colour}));
    }

    // Of a surface that folds over itself only the layer in front, tinted by what is behind it: depth first, then colour.
    surface(part) {
      const geometry = this.mesh(part);
      geometry.computeVertexNormals();
      const depth = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({colorWrite: false, side: THREE.DoubleSide}));
      depth.renderOrder = 1;
      const skin = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(
        {color: WATER, transparent: true, opacity: 0.62, side: THREE.DoubleSide}));
      skin.renderOrder = 2;
      return [depth, skin];
    }

    wetted(part) {
      const glass = new THREE.Mesh(this.mesh(part), new THREE.MeshBasicMaterial(
        {color: WATER, transparent: true, opacity: 0.13, depthWrite: false, side: THREE.DoubleSide}));
      glass.renderOrder = 3;
      return glass;
    }

    walls(part, colour) {
      const geometry = this.mesh(part);
      geometry.computeVertexNormals();
      const walls = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(
        {color: colour, transparent: true, opacity: 0.45, depthWrite: false, side: THREE.DoubleSide}));
      walls.renderOrder = 4;
      return walls;
    }

    spheres(part) {
      const radii = Float32Array.from(numbers(part.radii, Uint16Array), r => r / 65535 * this.data.largest / this.size);
      const speeds = numbers(part.speeds, Uint8Array), colours = new Float32Array(3 * speeds.length);
      for (let i = 0; i < colours.length; ++i) colours[i] = this.palette[3 * speeds[(i / 3) | 0] + i % 3] / 255;
      const geometry = new THREE.InstancedBufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(
        new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
      geometry.setIndex([0, 1, 2, 0, 2, 3]);
      geometry.setAttribute("centre", new THREE.InstancedBufferAttribute(this.points(part.positions).array, 3));
      geometry.setAttribute("radius", new THREE.InstancedBufferAttribute(radii, 1));
      geometry.setAttribute("colour", new THREE.InstancedBufferAttribute(colours, 3));
      const spheres = new THREE.Mesh(geometry, new THREE.ShaderMaterial({uniforms: {least: {value: 0}}, ...SPHERES}));
      spheres.frustumCulled = false;
      return spheres;
    }

    // ---------------------------------------------------------------------------------------- drawing, when asked
    draw() {
      if (this.asked) return;
      this.asked = requestAnimationFrame(() => {
        this.asked = 0;
        for (const [name, box] of Object.entries(this.boxes))
          for (const object of this.layers[name] || []) object.visible = box.checked;
        const height = (this.camera.top - this.camera.bottom) / this.camera.zoom;
        for (const spheres of this.layers.particles || [])
          spheres.material.uniforms.least.value = 0.75 * height / this.stage.clientHeight; // 0.75 px
        this.renderer.render(this.scene, this.camera);
        this.write();
      });
    }

    // Lengths along the box: on the lowest of its edges along each axis, upright on the one farthest left.
    write() {
      const width = this.stage.clientWidth, height = this.stage.clientHeight;
      const corners = this.corners().map(([x, y]) => [0.5 * (1 + x) * width, 0.5 * (1 - y) * height]);
      const middle = [0, 1].map(i => 0.5 * (corners[0][i] + corners[7][i]));
      for (let axis = 0; axis < 3; ++axis) {
        const edges = [0, 1, 2, 3, 4, 5, 6, 7].filter(bits => !(bits >> axis & 1))
          .map(bits => [corners[bits], corners[bits | 1 << axis]]);
        const upright = axis === this.data.vertical[0];
        const rank = ([a, b]) => upright ? -(a[0] + b[0]) : a[1] + b[1];
        const [a, b] = edges.sort((one, two) => rank(two) - rank(one))[0];
        const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
        let out = [(a[1] - b[1]) / (length || 1), (b[0] - a[0]) / (length || 1)];
        if (out[0] * (a[0] - middle[0]) + out[1] * (a[1] - middle[1]) < 0) out = out.map(x => -x);
        const texts = [short(this.data.lower[axis]), `${"xyz"[axis]} [m]`, short(this.data.upper[axis])];
        [0.04, 0.5, 0.96].forEach((along, i) => {
          const label = this.labels[axis][i];
          label.textContent = texts[i];
          label.hidden = length < 40;
          label.style.left = `${a[0] + along * (b[0] - a[0]) + 24 * out[0]}px`;
          label.style.top = `${a[1] + along * (b[1] - a[1]) + 14 * out[1]}px`;
        });
      }
    }
  }

  document.querySelectorAll("figure.view").forEach(figure => new View(figure));
})();
