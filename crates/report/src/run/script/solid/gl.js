// How the model is drawn where there is a graphics processor: WebGL 2. One canvas that nobody sees draws for all stages.

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) return null;
  const at = {};
  const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; i++) {
    const { name } = gl.getActiveUniform(made, i);
    at[name.replace("[0]", "")] = gl.getUniformLocation(made, name);
  }
  return { made, at };
}

/** A texture that holds numbers, so many in a texel, row after row. */
class Table {
  constructor(gl, count, [inside, format, type, array]) {
    Object.assign(this, { gl, format, type });
    this.rows = Math.max(1, Math.ceil(count / ROW));
    const each = { [gl.RGB]: 3, [gl.RGBA]: 4, [gl.RED]: 1 }[format];
    this.data = new array(this.rows * ROW * each);
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, inside, ROW, this.rows);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    this.send();
  }

  send() {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ROW, this.rows, this.format, this.type, this.data);
  }
}

/** What a browser calls a graphics processor where a processor does its work. */
const SLOW = /swiftshader|llvmpipe|softpipe|software|basic render/i;

class Graphics {
  constructor(canvas = document.createElement("canvas")) {
    this.canvas = canvas;
    const gl = this.gl = this.canvas.getContext("webgl2", { antialias: true });
    if (!gl) { this.broken = true; return; }
    // A large model is drawn faster by a processor that has to draw this model alone.
    const name = gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER;
    if (gl.isContextLost() || (DENSE && SLOW.test(gl.getParameter(name)))) { this.broken = true; return; }
    this.programs = {};
    for (const [name, text] of Object.entries({ MEMBER, LINE, FACE, SYMBOL, DOT, GROUND })) {
      const made = program(gl, text, PAINT);
      if (!made) { this.broken = true; return; }
      this.programs[name] = made;
    }
    gl.enable(gl.DEPTH_TEST);
  }

  /** Numbers that drawings read by point or by mark: of `vector`, `look` or `value`. */
  table(count, what) {
    const { gl } = this;
    return new Table(gl, count, {
      vector: [gl.RGB32F, gl.RGB, gl.FLOAT, Float32Array],
      look: [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, Uint8Array],
      value: [gl.R32F, gl.RED, gl.FLOAT, Float32Array],
    }[what]);
  }

  /** What one call draws: a mesh, once or for many instances. `attributes`: place → [numbers, how many each, 1 for instances];
   *  faces: their corners, in the order in which they go round. */
  batch(attributes, faces) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    let vertices = 0, instances = 0;
    for (const [place, [data, each, step]] of Object.entries(attributes)) {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place);
      if (data instanceof Int32Array) gl.vertexAttribIPointer(place, each, gl.INT, 0, 0);
      else gl.vertexAttribPointer(place, each, gl.FLOAT, false, 0, 0);
      gl.vertexAttribDivisor(place, step);
      if (step) instances = data.length / each; else vertices = data.length / each;
    }
    const index = faces?.flatMap((f) => f.slice(2).flatMap((c, i) => [f[0], f[i + 1], c]));
    if (index) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(index), gl.STATIC_DRAW);
    }
    gl.bindVertexArray(null);
    return { array, vertices, instances, index: index?.length ?? 0 };
  }

  /** An empty picture in the lower left corner, for drawings with what all of them share. */
  begin([wide, high], common, tables) {
    const { gl, canvas } = this;
    if (canvas.width < wide) canvas.width = wide;
    if (canvas.height < high) canvas.height = high;
    Object.assign(this, { size: [wide, high], common });
    gl.viewport(0, 0, wide, high);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    Object.values(tables).forEach((t, i) => { gl.activeTexture(gl.TEXTURE0 + i); gl.bindTexture(gl.TEXTURE_2D, t.texture); });
  }

  /** One call with what all share and what it has beside; over: in front of all that is there. */
  use(name, set, { array, vertices, instances, index }, over = false) {
    const { gl } = this, { made, at } = this.programs[name];
    gl.depthFunc(over ? gl.ALWAYS : gl.LEQUAL);
    gl.useProgram(made);
    const all = { ...FREE, rest: 0, moved: 1, looks: 2, values: 3, ...this.common, ...set };
    for (const [key, place] of Object.entries(at)) {
      const x = all[key];
      if (x == null) continue;
      if (key === "palette") gl.uniform3fv(place, x);
      else if (["rest", "moved", "looks", "values", "tint"].includes(key)) gl.uniform1i(place, x);
      else if (Array.isArray(x)) gl[`uniform${x.length}fv`](place, x);
      else gl.uniform1f(place, x);
    }
    const mode = { LINE: gl.TRIANGLE_STRIP, GROUND: gl.TRIANGLE_STRIP, DOT: gl.POINTS }[name] ?? gl.TRIANGLES;
    gl.bindVertexArray(array);
    if (index && instances) gl.drawElementsInstanced(mode, index, gl.UNSIGNED_INT, 0, instances);
    else if (index) gl.drawElements(mode, index, gl.UNSIGNED_INT, 0);
    else if (instances) gl.drawArraysInstanced(mode, 0, vertices, instances);
    else gl.drawArrays(mode, 0, vertices);
  }

  /** Lays the picture over what a context has, as wide and high as that counts. */
  lay(c, width, height) {
    const [wide, high] = this.size;
    this.gl.activeTexture(this.gl.TEXTURE0);
    c.drawImage(this.canvas, 0, this.canvas.height - high, wide, high, 0, 0, width, height);
  }
}
