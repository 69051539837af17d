// The bodies: one instanced mesh for all of one form, and the lines of their edges.

const WALL = 2.5;  // sizes of a typical body: what is larger may be a wall
const FLOWN = 3;  // times the median distance: what is farther has left the heap
const SMALL = 0.1;  // sizes per distance: half a pixel is less than what coarser surfaces change
const CREASE = Math.cos(25 * Math.PI / 180);  // flatter edges are not drawn
// A window through all that stands before what is selected: its middle and radius (0: none), and whether it opens for a colour.
const WINDOW = `
  uniform vec4 window;
  bool opens(vec3 seen, float alpha) {
    if (window.w <= 0. || alpha > 1.5) return false;
    vec3 middle = (viewMatrix * vec4(window.xyz, 1.)).xyz, ray = normalize(seen);
    float along = dot(middle, ray);
    return dot(seen, ray) < along && length(middle - along * ray) < window.w;
  }`;
const windowed = { value: null };
const TONE = `
  uniform vec3 tones; uniform vec2 borders; varying vec4 vTint; varying vec3 vNormal, vSeen;
  float toneOf(vec3 n) {
    float lit = dot(n, normalize(vec3(-.5, .75, .62)));
    return lit > borders.x ? tones.x : lit > borders.y ? tones.y : tones.z;
  }`;
const SURFACE = [TONE + `
  attribute vec4 tint;
  #ifdef WALL
  uniform vec3 subject; uniform float wall; varying vec2 vCut;
  #endif
  void main() {
    vec4 seen = viewMatrix * instanceMatrix * vec4(position, 1.);
    vNormal = (viewMatrix * instanceMatrix * vec4(normal, 0.)).xyz; vSeen = seen.xyz; vTint = tint;
    #ifdef FLAT
    vTint.rgb *= toneOf(normalize(vNormal));
    #endif
    #ifdef WALL
    vec3 middle = (viewMatrix * vec4(subject, 1.)).xyz;
    vCut = vec2(fract(tint.a) > .1 ? dot(normalize(vNormal), middle - vSeen) + wall : 1., dot(middle, middle));
    #endif
    gl_Position = projectionMatrix * seen;
  }`, TONE + WINDOW + `
  uniform vec3 edge; uniform float alpha;
  #ifdef WALL
  varying vec2 vCut;
  #endif
  void main() {
    #ifdef WALL
    // A wall in front of the contacts is cut away: they are behind its face, and farther from the eye.
    if (vCut.x < 0. && dot(vSeen, vSeen) < vCut.y) discard;
    #elif defined(OPENS)
    if (opens(vSeen, vTint.a)) discard;
    #endif
    #ifdef FLAT
    gl_FragColor = vec4(vTint.rgb, alpha);
    #else
    vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1. : -1.);
    gl_FragColor = vec4(vTint.rgb * toneOf(n), alpha);
    #endif
    #ifdef ROUND
    float facing = abs(dot(n, normalize(vSeen)));
    float outline = 1. - smoothstep(1., 1.6, facing / (fwidth(facing) * (vTint.a > 1.5 ? 3. : 1.6) + 1e-5));
    gl_FragColor = vec4(mix(gl_FragColor.rgb, edge, outline), max(alpha, outline));
    #endif
  }`];
const point3 = ([x, y, z]) => new THREE.Vector3(x, y, z);
/** Moves a geometry: +`axis` becomes `direction`. */
const laid = (geometry, axis, direction, middle) => {
  const turn = new THREE.Quaternion().setFromUnitVectors(axis, direction.clone().normalize());
  return geometry.applyMatrix(new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(1, 1, 1)));
};

/** The surface of a shape in its frame. `reach`: half of the width at which planes are drawn. `detail`: 1; less for what is small on screen. */
function surfaceOf(shape, reach, detail = 1) {
  const ends = (shape.vertices || []).map(point3), radius = shape.radius || 0;
  if (shape.half_space) {
    const normal = point3(shape.half_space.normal), plane = new THREE.PlaneBufferGeometry(2 * reach, 2 * reach);
    return { open: true, geometry: laid(plane, new THREE.Vector3(0, 0, 1), normal, normal.clone().multiplyScalar(shape.half_space.offset)) };
  }
  if (!(radius > 0) || ends.length > 2) return { geometry: polyhedron(shape.vertices || [], shape.faces || []), open: shape.type === 'mesh' };
  // A capsule about y; a sphere is a short one.
  const unit = unitSphere(detail), geometry = unit.clone(), { array } = geometry.attributes.position, arc = Math.round(10 * detail), ring = 2 * arc + 2;
  const last = ends[ends.length - 1], along = last.clone().sub(ends[0]), half = along.length() / 2;
  for (let i = 0; i < array.length; i += 3) {
    for (let k = 0; k < 3; ++k) array[i + k] *= radius;
    array[i + 1] += i / 3 % ring <= arc ? -half : half;
  }
  return { round: true, geometry: laid(geometry, new THREE.Vector3(0, 1, 0), half > 0 ? along : new THREE.Vector3(0, 1, 0), ends[0].clone().addScaledVector(along, 0.5)) };
}
/** Of radius 1, with two rings at its equator. Computed once, since that takes most of the time of opening a heap. */
const units = new Map();
function unitSphere(detail) {
  if (units.has(detail)) return units.get(detail);
  const profile = [], arc = Math.round(10 * detail);
  for (let i = 0; i < 2 * arc + 2; ++i) {
    const angle = Math.PI * ((i <= arc ? i : i - 1) / (2 * arc) - 0.5);
    profile.push(new THREE.Vector2(Math.max(1e-6, Math.cos(angle)), Math.sin(angle)));
  }
  const made = new THREE.LatheBufferGeometry(profile, 28 * detail);
  made.attributes.normal.array.set(made.attributes.position.array);
  return units.set(detail, made).get(detail);
}
function polyhedron(vertices, faces) {
  const geometry = new THREE.BufferGeometry();
  const corners = faces.flatMap(face => face.slice(2).flatMap((_, i) => [face[0], face[i + 1], face[i + 2]]));
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(corners.flatMap(corner => vertices[corner])), 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Edges where two faces meet at an angle, and borders; of a mesh all, unless there are too many: { ends, flat }. */
function creases(shape) {
  const vertices = (shape.vertices || []).map(point3), found = new Map();
  for (const face of shape.radius > 0 ? [] : shape.faces || []) {
    const normal = new THREE.Vector3(), end = i => face[(i + 1) % face.length];
    face.forEach((corner, i) => normal.add(vertices[corner].clone().cross(vertices[end(i)])));
    normal.normalize();
    face.forEach((corner, i) => {
      const key = Math.min(corner, end(i)) + ' ' + Math.max(corner, end(i)), known = found.get(key);
      if (known) known.angle = known.normal.dot(normal);
      else found.set(key, { ends: [corner, end(i)], normal, angle: -1 });
    });
  }
  const all = shape.type === 'mesh' && found.size < 6000;
  return [...found.values()].map(({ ends, angle }) => ({ ends, flat: angle >= CREASE })).filter(edge => all || !edge.flat);
}

class Bodies {
  /** `opaque`: bodies hide what is behind them. */
  constructor(scene, opaque) {
    // A body is an `a` if it is first in the first pair that names it.
    this.isA = data.shapes.map((_, body) => (data.pairs.find(([a, b]) => a === body || b === body) || [body])[0] === body);
    this.boxes = data.shapes.map(shape => new THREE.Box3().setFromPoints((shape.vertices || []).map(point3)));
    this.sizes = this.boxes.map((box, body) => box.isEmpty() ? 0 : box.getSize(new THREE.Vector3()).length() + 2 * (data.shapes[body].radius || 0));
    const sizes = this.sizes.filter(size => size > 0).sort((a, b) => a - b);
    this.size = sizes[sizes.length >> 1] || 1;  // of a typical body, metres
    this.reach = 1.5 * (sizes.pop() || 4);
    const isWall = this.isWall = data.shapes.map((shape, body) => opaque && (shape.half_space || shape.type !== 'mesh' && this.sizes[body] > WALL * this.size));
    // The thinnest wall, so that one is cut away too if the contacts are on its other face.
    const thinnest = this.boxes.reduce((least, box, body) => isWall[body] && !box.isEmpty() ? Math.min(least, ...box.getSize(new THREE.Vector3()).toArray()) : least, Infinity);
    this.wall = Math.min(0.2 * this.size, 0.4 * thinnest);
    this.creases = data.shapes.map(creases);
    this.subject = { value: new THREE.Vector3() };  // the middle of the contacts
    this.opaque = opaque;
    this.tones = { value: new THREE.Vector3() };
    this.materials = {};
    this.matrices = data.shapes.map(() => new THREE.Matrix4());
    this.here = data.shapes.map(() => false);
    this.isCut = data.shapes.map(() => false);
    this.probe = new THREE.Mesh();
    windowed.value = new THREE.Vector4();
    this.lines = new Lines(1, WINDOW, windowed);
    const forms = new Map(), deformed = new Set(Object.values(data.deformed).flatMap(Object.keys));
    data.shapes.forEach((shape, body) => {
      const key = JSON.stringify([shape.vertices, shape.faces, shape.radius, shape.half_space, deformed.has(shape.name) && body]);
      forms.set(key, [...forms.get(key) || [], body]);
    });
    this.forms = [...forms.values()].map(members => {
      const { geometry, open, round } = surfaceOf(data.shapes[members[0]], this.reach);
      const tints = setAttribute(geometry, 'tint', new Float32Array(4 * members.length), 4, true);
      // One material for all bodies of a kind; without a GPU each change of it takes time, and so does what is hidden.
      const wall = Boolean(isWall[members[0]]), material = this.materials[[open, round, wall]] ??= new THREE.ShaderMaterial({ vertexShader: SURFACE[0], fragmentShader: SURFACE[1],
        transparent: !opaque, depthWrite: opaque, side: open ? THREE.DoubleSide : THREE.FrontSide, extensions: { derivatives: true },
        defines: { ...round && { ROUND: 1 }, ...!round && !open && { FLAT: 1 }, ...wall && { WALL: 1 } },
        uniforms: { tones: this.tones, borders: { value: new THREE.Vector2(...data.tone_borders) },
          edge: { value: new THREE.Vector3() }, alpha: { value: opaque ? 1 : 0.62 }, window: windowed, subject: this.subject, wall: { value: wall ? this.wall : 0 } } });
      const mesh = Object.assign(new THREE.InstancedMesh(geometry, material, members.length), { frustumCulled: false });
      scene.add(mesh);
      return { members, mesh, tints, geometry, round };
    });
    scene.add(this.lines.object);
  }

  place(frame) {
    const one = new THREE.Vector3(1, 1, 1), q = new THREE.Quaternion();
    data.shapes.forEach((shape, body) => {
      const pose = poseOf(body, frame);
      this.here[body] = Boolean(pose);
      if (pose) this.matrices[body].compose(point3(pose), q.set(pose[4], pose[5], pose[6], pose[3]).normalize(), one);
      const deformed = (data.deformed[frame] || {})[shape.name];
      if (!deformed) return;
      shape.vertices = deformed.vertices;
      const { geometry } = this.forms.find(form => form.members[0] === body).mesh, form = polyhedron(shape.vertices, shape.faces);
      for (const name of ['position', 'normal']) geometry.attributes[name].copy(form.attributes[name]).needsUpdate = true;
    });
  }

  /** The bodies with a place, from the smallest. */
  bySize(bodies) { return bodies.filter(one => this.here[one] && !this.boxes[one].isEmpty()).sort((a, b) => this.sizes[a] - this.sizes[b]); }
  /** The sphere about a body, where it is now or in a frame: [x, y, z, radius]. */
  sphere(body, frame) {
    const middle = this.boxes[body].getCenter(new THREE.Vector3()), pose = frame === undefined ? null : poseOf(body, frame);
    if (pose) middle.applyQuaternion(new THREE.Quaternion(pose[4], pose[5], pose[6], pose[3])).add(point3(pose));
    else middle.applyMatrix4(this.matrices[body]);
    return [...middle.toArray(), this.sizes[body] / 2];
  }
  /** Spheres about all bodies of a frame but planes, walls and what has flown off: it is farther from the median than most by a factor. Sets `middle`, the median, and `flown`, how many those are. */
  heap(frame) {
    if (this.heaped && this.heaped.frame === frame) return this.heaped.spheres;
    const all = data.shapes.map((_, body) => body).filter(body => poseOf(body, frame) && !this.boxes[body].isEmpty()), small = all.filter(body => this.sizes[body] <= WALL * this.size);
    const spheres = (small.length ? small : all).map(body => this.sphere(body, frame)), median = list => list.sort((a, b) => a - b)[list.length >> 1];
    const middle = [0, 1, 2].map(k => median(spheres.map(at => at[k])) ?? 0), far = spheres.map(at => Math.hypot(...middle.map((x, k) => at[k] - x)));
    Object.assign(this, { middle: point3(middle), flown: 0 });
    const limit = FLOWN * median([...far]) + 2 * this.size;
    this.heaped = { frame, spheres: spheres.filter((_, i) => far[i] <= limit || !++this.flown) };
    return this.heaped.spheres;
  }
  /** Spheres about what to look at if these bodies are selected: their corners, but not those of what is much larger than the smallest; and the record's points. */
  outline(chosen, record) {
    const bodies = this.bySize(chosen), places = [];
    for (const body of bodies.filter(one => this.sizes[one] < 4 * this.sizes[bodies[0]])) {
      const { vertices, radius = 0 } = data.shapes[body];
      for (const vertex of vertices) places.push([...point3(vertex).applyMatrix4(this.matrices[body]).toArray(), radius]);
    }
    if (record >= 0) eachPoint(record, i => places.push([...positionOf(i), 0]));
    return places;
  }
  /** Cuts away the walls between an eye and the subject; true if there are any. One with a face that both see is not between them. */
  cut(eye) {
    const { subject: { value: subject }, matrices } = this, normal = new THREE.Vector3();
    for (const { members, tints } of this.forms)
      for (const [i, body] of members.entries()) {
        if (!this.isWall[body]) continue;
        const { faces = [], vertices } = data.shapes[body], sides = faces.map(face => {
          const [a, b, c] = face.map(corner => point3(vertices[corner]));
          normal.copy(b.sub(a)).cross(c.sub(a)).transformDirection(matrices[body]);
          const offset = normal.dot(a.applyMatrix4(matrices[body]));
          return [normal.dot(eye) - offset, normal.dot(subject) - offset];
        });
        this.isCut[body] = this.here[body] && (!faces.length || sides.some(([far, near]) => far > 0 && near < -this.wall) && !sides.some(([far, near]) => far > 0 && near > 0));
        const alpha = Math.floor(tints.array[4 * i + 3]) + (this.isCut[body] ? 0.25 : 0);
        if (alpha !== tints.array[4 * i + 3]) tints.needsUpdate = true;
        tints.array[4 * i + 3] = alpha;
      }
    return this.isCut.some((isCut, body) => isCut && (data.shapes[body].faces || []).length);
  }

  /** Opens a window to the smaller of the bodies, at their contacts if there are any in the record, or at a `place`. `middle`: the subject if there are none. */
  open(chosen, record, middle, place) {
    const body = this.bySize(chosen)[0], at = [];
    windowed.value.set(0, 0, 0, 0);
    this.subject.value.copy(middle);
    const isOpen = body !== undefined && this.opaque;
    // Only then, since no fragment is left out early where any may be discarded.
    for (const material of Object.values(this.materials))
      if (Boolean(material.defines.OPENS) !== isOpen && !material.defines.WALL) {
        if (isOpen) material.defines.OPENS = true;
        else delete material.defines.OPENS;
        material.needsUpdate = true;
      }
    if (!isOpen) return;
    if (record >= 0) eachPoint(record, i => at.push(point3(positionOf(i))));
    if (!at.length && place) at.push(point3(place));
    this.subject.value.copy(at.length ? at.reduce((sum, one) => sum.add(one), new THREE.Vector3()).divideScalar(at.length) : point3(this.sphere(body)));
    const far = this.outline(chosen, -1).reduce((most, [x, y, z, radius]) => Math.max(most, this.subject.value.distanceTo(new THREE.Vector3(x, y, z)) + radius), 0);
    windowed.value.set(...this.subject.value.toArray(), Math.min(far, 1.6 * this.size));
  }

  /** `chosen`: bodies that stand out. */
  draw(shown, chosen) {
    const edge = color.get('edge'), none = new THREE.Matrix4().makeScale(0, 0, 0), { lines, matrices, creases } = this;
    lines.rows = 0;
    // On a dark ground tones differ more, and what stands out is lighter.
    const isDark = color.get('ground')[0] < 0.5;
    this.tones.value.fromArray(data.tones.map(tone => isDark ? 1.15 * tone ** 2.5 : tone));
    for (const { members, mesh, tints } of this.forms) {
      members.forEach((body, i) => {
        const stands = chosen.has(body), wide = stands ? 3 : creases[body].length > 400 ? 0.7 : 1.4;
        mesh.setMatrixAt(i, this.here[body] ? matrices[body] : none);
        const tint = [...color.get(this.isA[body] ? 'shape_a' : 'shape_b').map(c => Math.fround(stands ? c * (isDark ? 1.35 : 0.86) : c)), (stands ? 2 : 1) + (this.isCut[body] ? 0.25 : 0)];
        if (tint.some((x, k) => x !== tints.array[4 * i + k])) tints.needsUpdate = true;
        tints.array.set(tint, 4 * i);
        if (!shown || !this.here[body] || !creases[body].length) return;
        const world = data.shapes[body].vertices.map(vertex => point3(vertex).applyMatrix4(matrices[body]).toArray());
        for (const { ends: [from, to], flat } of creases[body]) lines.add(world[from], world[to], edge, flat ? 0.7 : wide, stands ? 2 : flat ? 0.25 : wide < 1 ? 0.5 : 1);
      });
      mesh.instanceMatrix.needsUpdate = true;
      mesh.material.uniforms.edge.value.set(...edge);
      mesh.visible = shown;
    }
    lines.object.material.depthTest = this.opaque;
    lines.flush();
  }

  /** Draws the bodies nearest to the eye first, so that they hide others before their colours are computed. */
  sort(eye) {
    const at = new THREE.Vector3();
    for (const form of this.opaque ? this.forms : []) {
      const { members, mesh, geometry, tints, round } = form, far = at.setFromMatrixPosition(this.matrices[members[0]]).distanceTo(eye);
      mesh.renderOrder = far / (1 + far);
      const isCoarse = round && members.length === 1 && this.sizes[members[0]] < SMALL * far;
      if (isCoarse) form.coarse ??= surfaceOf(data.shapes[members[0]], this.reach, 0.75).geometry.setAttribute('tint', tints);
      mesh.geometry = isCoarse ? form.coarse : geometry;
    }
  }

  /** The nearest body on a ray; -1 without one. */
  hit(raycaster) {
    const hits = [];
    for (const { members, mesh, tints } of this.forms)
      for (const body of members.filter(member => this.here[member])) {
        Object.assign(this.probe, { geometry: mesh.geometry, material: mesh.material, matrixWorld: this.matrices[body], body });
        const met = [], { wall, subject: { value: subject } } = mesh.material.uniforms, { origin } = raycaster.ray;
        this.probe.raycast(raycaster, met);
        // Nothing is hit where the shader cuts a wall away, or opens a window.
        const { x, y, z, w } = windowed.value, middle = new THREE.Vector3(x, y, z), isChosen = tints.array[4 * members.indexOf(body) + 3] > 1.5;
        const isCut = ({ face, point, distance }) => this.isCut[body] && distance < origin.distanceTo(subject) &&
          face.normal.clone().transformDirection(this.matrices[body]).dot(subject.clone().sub(point)) < -wall.value ||
          !(wall.value > 0) && !isChosen && distance < middle.clone().sub(origin).dot(raycaster.ray.direction) && raycaster.ray.distanceToPoint(middle) < w;
        for (const hit of met) if (!isCut(hit)) hits.push(Object.assign(hit, { body }));
      }
    return hits.sort((a, b) => a.distance - b.distance).map(hit => hit.body)[0] ?? -1;
  }
}
