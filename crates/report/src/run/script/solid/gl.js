// WebGL 2 in a few functions: a program with its uniforms, a texture of numbers, buffers of instances.

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

/** What one call draws: a mesh, once or for many instances. `attributes`: place → [numbers, how many each, 1 for instances]. */
function batch(gl, attributes, index) {
  const array = gl.createVertexArray();
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
  if (index) {
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(index), gl.STATIC_DRAW);
  }
  gl.bindVertexArray(null);
  return { array, vertices, instances, index: index?.length ?? 0 };
}

function call(gl, { array, vertices, instances, index }, mode) {
  gl.bindVertexArray(array);
  if (index && instances) gl.drawElementsInstanced(mode, index, gl.UNSIGNED_INT, 0, instances);
  else if (index) gl.drawElements(mode, index, gl.UNSIGNED_INT, 0);
  else if (instances) gl.drawArraysInstanced(mode, 0, vertices, instances);
  else gl.drawArrays(mode, 0, vertices);
}
