// Marks above the bodies: lines with a width in pixels, dots, and translucent polygons. Each is refilled for a frame.

const PIXELS = { value: null };  // size of the canvas, shared by the shaders
const color = new Map();         // role -> [r, g, b] of the theme
const setAttribute = (geometry, name, array, size, instanced) => {
  const attribute = instanced ? new THREE.InstancedBufferAttribute(array, size) : new THREE.BufferAttribute(array, size);
  geometry.setAttribute(name, attribute.setUsage(THREE.DynamicDrawUsage));
  return attribute;
};

/** Buffers that grow: push() rows, then flush() them. A row is one vertex, or the four of a quad: instances would be slower without a GPU. */
class Marks {
  /** `sizes`: numbers of a row, by attribute. */
  constructor(object, order, sizes, isQuad) {
    Object.assign(object, { frustumCulled: false, renderOrder: order });
    Object.assign(this, { object, sizes, copies: isQuad ? 4 : 1, rows: 0, room: 0 });
    this.grow(256);
  }
  grow(room) {
    const { object: { geometry }, copies } = this;
    for (const [name, size] of Object.entries(this.sizes)) {
      const array = new Float32Array(room * copies * size);
      if (this.room) array.set(geometry.attributes[name].array);
      setAttribute(geometry, name, array, size);
    }
    if (copies > 1) {
      geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from({ length: 8 * room }, (_, i) => [0, -1, 0, 1, 1, -1, 1, 1][i % 8]), 2));
      geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from({ length: 6 * room }, (_, i) => 4 * Math.floor(i / 6) + [0, 1, 2, 2, 1, 3][i % 6]), 1));
    }
    this.room = room;
  }
  push(values) {
    if (this.rows === this.room) this.grow(2 * this.room);
    for (const name in this.sizes) {
      const size = this.sizes[name], { array } = this.object.geometry.attributes[name], at = this.rows * this.copies * size;
      array.set(values[name], at);
      for (let i = 1; i < this.copies; ++i) array.copyWithin(at + i * size, at, at + size);
    }
    ++this.rows;
  }
  flush() {
    const { geometry } = this.object;
    for (const name in this.sizes) Object.assign(geometry.attributes[name], { needsUpdate: true }).updateRange.count = this.rows * this.copies * this.sizes[name];
    geometry.setDrawRange(0, this.rows * (this.copies > 1 ? 6 : 1));
    this.object.visible = this.rows > 0;
  }
}
const shader = (vertexShader, fragmentShader, more) => new THREE.ShaderMaterial({ vertexShader, fragmentShader, transparent: true, depthWrite: false,
  uniforms: { pixels: PIXELS, toward: { value: 0 }, fade: { value: 1 }, halo: { value: new THREE.Vector3() } }, ...more });

/** Segments; the head of an arrow is one that gets thinner. `opening`: of a shader function that leaves parts of them out, and its uniform. */
class Lines extends Marks {
  constructor(order, opening = 'bool opens(vec3 seen, float alpha) { return false; }', uniform = null) {
    super(new THREE.Mesh(new THREE.BufferGeometry(), shader(`
      uniform vec2 pixels; attribute vec3 from, to, wide; attribute vec4 tint; varying vec4 vTint; varying vec2 vDash; varying vec3 vSeen;
      void main() {
        vSeen = (viewMatrix * vec4(position.x < .5 ? from : to, 1.)).xyz;
        // A little nearer than the surfaces on which they are.
        vec4 a = projectionMatrix * vec4((viewMatrix * vec4(from, 1.)).xyz * .997, 1.), b = projectionMatrix * vec4((viewMatrix * vec4(to, 1.)).xyz * .997, 1.);
        float near = 1e-4;
        if (a.w < near && b.w > near) a = mix(a, b, (near - a.w) / (b.w - a.w));
        if (b.w < near && a.w > near) b = mix(b, a, (near - b.w) / (a.w - b.w));
        vec2 way = (b.xy / b.w - a.xy / a.w) * pixels;
        float far = length(way) * .5;
        way = far > 0. ? way / (2. * far) : vec2(1., 0.);
        gl_Position = position.x < .5 ? a : b;
        gl_Position.xy += vec2(-way.y, way.x) * position.y * mix(wide.x, wide.y, position.x) / pixels * gl_Position.w;
        vTint = tint; vDash = vec2(position.x * far, wide.z);
      }`, opening + 'varying vec4 vTint; varying vec2 vDash; varying vec3 vSeen; void main() { if (vDash.y > 0. && mod(vDash.x, 2. * vDash.y) > vDash.y || opens(vSeen, vTint.a)) discard; gl_FragColor = vTint; }',
    { depthTest: false, side: THREE.DoubleSide })), order, { from: 3, to: 3, tint: 4, wide: 3 }, true);
    if (uniform) this.object.material.uniforms.window = uniform;
  }
  add(from, to, rgb, width, alpha = 1, dash = 0) { this.push({ from, to, tint: [...rgb, alpha], wide: [width, width, dash] }); }
  loop(corners, rgb, width, dash) { corners.forEach((corner, i) => this.add(corner, corners[(i + 1) % corners.length], rgb, width, 1, dash)); }
  arrow(from, way, length, rgb, width) {
    const at = share => [0, 1, 2].map(k => from[k] + way[k] * length * share);
    this.add(from, at(0.75), rgb, width);
    this.push({ from: at(0.72), to: at(1), tint: [...rgb, 1], wide: [width * 4.5, 0, 0] });
  }
}

/** Forms of dots, as in pictures. */
const DOT = 0, RING = 1, CROSS = 2, HOLLOW = 3, WIDE_RING = 4, STRONG = 8;  // added to one that is not faint behind bodies

/** Drawn twice: faint behind bodies, then in full what is in front or at most a little inside. */
class Dots extends Marks {
  constructor(scene) {
    const make = depthTest => shader(`
      uniform float toward, fade; attribute vec3 tint; attribute vec2 form; varying vec3 vTint; varying vec2 vForm; varying float vFade;
      void main() {
        vec4 seen = viewMatrix * vec4(position, 1.);
        seen.xyz *= max(.02, 1. - toward / length(seen.xyz));
        gl_Position = projectionMatrix * seen; gl_PointSize = form.y; vForm = vec2(mod(form.x, 8.), form.y); vTint = tint; vFade = form.x > 7.5 ? 1. : fade;
      }`, `
      uniform vec3 halo; varying vec3 vTint; varying vec2 vForm; varying float vFade;
      void main() {
        vec2 p = (gl_PointCoord - .5) * vForm.y;
        float r = length(p), R = vForm.y * .5 - 2., soft = R + 2. - r, inner = 0.;
        if (vForm.x < .5) inner = clamp(r - R + .5, 0., 1.);
        else if (vForm.x < 1.5) soft = 1.4 - abs(r - R);
        else if (vForm.x < 2.5) soft = min(R - r, 1.4 - min(abs(p.x - p.y), abs(p.x + p.y)) * .7);
        else if (vForm.x > 3.5) { soft = 3. - abs(r - R); inner = clamp(abs(r - R) - .8, 0., 1.); }
        else { soft = R + .5 - r; inner = clamp(R - 1.5 - r, 0., 1.); }
        if (soft <= 0.) discard;
        gl_FragColor = vec4(mix(vTint, halo, inner), vFade * min(1., soft));
      }`, { depthTest });
    super(new THREE.Points(new THREE.BufferGeometry(), make(true)), 9, { position: 3, tint: 3, form: 2 }, false);
    this.faint = Object.assign(new THREE.Points(this.object.geometry, make(false)), { frustumCulled: false, renderOrder: 8 });
    scene.add(this.object, this.faint);
  }
  add(position, rgb, form, radius) { this.push({ position, tint: rgb, form: [form, (2 * radius + 4) * devicePixelRatio] }); }
  look(toward, fade) {
    this.object.material.uniforms.toward.value = toward;
    this.faint.material.uniforms.fade.value = fade;
    for (const { material } of [this.object, this.faint]) material.uniforms.halo.value.set(...color.get('ground'));
    this.faint.visible = this.object.visible;
  }
}

class Fills extends Marks {
  constructor() {
    super(new THREE.Mesh(new THREE.BufferGeometry(), shader(
      'attribute vec4 tint; varying vec4 vTint; void main() { vTint = tint; gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.); }',
      'varying vec4 vTint; void main() { gl_FragColor = vTint; }', { depthTest: false, side: THREE.DoubleSide })), 3, { position: 3, tint: 4 }, false);
  }
  polygon(corners, rgb, alpha) {
    for (let i = 2; i < corners.length; ++i)
      for (const position of [corners[0], corners[i - 1], corners[i]]) this.push({ position, tint: [...rgb, alpha] });
  }
}
