// A camera that orbits a target. Drag: orbit; right button, Shift or two fingers: pan; wheel or pinch: zoom.

const FIELD = 30 * Math.PI / 180;  // vertical

class Orbit {
  constructor(canvas, upIsZ, changed) {
    this.camera = new THREE.PerspectiveCamera();
    this.camera.up.set(0, upIsZ ? 0 : 1, upIsZ ? 1 : 0);
    this.aspect = 1;
    // Yaw: about up. Pitch: above the horizon.
    Object.assign(this, { canvas, upIsZ, changed, target: new THREE.Vector3(), yaw: 0.6, pitch: 0.4, distance: 5, pointers: new Map(), moved: false });
    canvas.addEventListener('pointerdown', event => this.down(event));
    canvas.addEventListener('pointermove', event => this.move(event));
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.pointers.delete(event.pointerId));
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), event);
    }, { passive: false });
  }

  /** `direction`: unit vector from the target to the eye. */
  lookFrom(direction) {
    const [x, y, z] = direction;
    this.pitch = Math.asin(Math.min(1, Math.max(-1, this.upIsZ ? z : y)));
    this.yaw = this.upIsZ ? Math.atan2(x, -y) : Math.atan2(x, z);
  }
  /** Unit vector from the target to the eye. */
  toEye() {
    const { yaw, pitch } = this, flat = Math.cos(pitch), [s, c, up] = [flat * Math.sin(yaw), flat * Math.cos(yaw), Math.sin(pitch)];
    return this.upIsZ ? new THREE.Vector3(s, -c, up) : new THREE.Vector3(s, up, c);
  }
  /** The nearest view of spheres [x, y, z, radius] with all of them in it, with `room` times their extent around: { target, distance }. `target`: where it looks, unless at their middle. */
  viewOf(spheres, room, target) {
    const back = this.toEye(), right = this.camera.up.clone().cross(back).normalize(), axes = [right, back.clone().cross(right), back];
    const tall = Math.tan(FIELD / 2) / Math.min(1, this.aspect), edges = [tall * this.aspect / room, tall / room];
    const along = spheres.map(([x, y, z]) => axes.map(axis => axis.x * x + axis.y * y + axis.z * z));
    const middle = target ? axes.map(axis => axis.dot(target)) : [0, 1, 2].map(k => {
      const [low, high] = [-1, 1].map(sign => sign * along.reduce((most, at, i) => Math.max(most, sign * at[k] + spheres[i][3]), -Infinity));
      return (low + high) / 2;
    });
    const distance = along.reduce((most, at, i) => Math.max(most, ...edges.map((edge, k) =>
      (Math.abs(at[k] - middle[k]) + spheres[i][3] * Math.hypot(1, edge)) / edge + at[2] - middle[2])), 0);
    return { target: axes.reduce((sum, axis, k) => sum.addScaledVector(axis, middle[k]), new THREE.Vector3()), distance };
  }
  place(width, height, reach) {
    const { camera, distance } = this;
    camera.aspect = this.aspect = width / height;
    // A view that is higher than wide keeps its width.
    camera.fov = 2 * Math.atan(Math.tan(FIELD / 2) / Math.min(1, camera.aspect)) * 180 / Math.PI;
    camera.near = distance / 50;
    camera.far = distance + reach * 3;
    camera.position.copy(this.target).addScaledVector(this.toEye(), distance);
    camera.lookAt(this.target);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    camera.matrixWorldInverse.getInverse(camera.matrixWorld);
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 1) this.moved = false;
    this.travel = 0;
  }
  move(event) {
    const last = this.pointers.get(event.pointerId), other = [...this.pointers].find(([id]) => id !== event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y, apart = () => Math.hypot(last.x - other[1].x, last.y - other[1].y) || 1;
    this.travel += Math.hypot(dx, dy);
    if (this.travel > 4) this.moved = true;
    if (!this.moved) return;
    const before = other && apart();
    Object.assign(last, { x: event.clientX, y: event.clientY });
    if (other) {  // two fingers: each moves half of the middle
      this.pan(dx / 2, dy / 2);
      this.zoom(before / apart());
    } else if (event.buttons & 6 || event.shiftKey) {
      this.pan(dx, dy);
    } else {
      this.yaw -= dx * 0.008;
      this.pitch = Math.min(1.55, Math.max(-1.55, this.pitch + dy * 0.008));
    }
    this.changed();
  }
  /** Pixels; what is under the pointer at the target's distance follows it. */
  pan(dx, dy) {
    const metres = 2 * this.distance * Math.tan(this.camera.fov * Math.PI / 360) / this.canvas.clientHeight;
    const axis = column => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, column);
    this.target.addScaledVector(axis(0), -dx * metres).addScaledVector(axis(1), dy * metres);
  }
  /** About the pointer, if there is one. */
  zoom(factor, event) {
    const nearer = Math.min(1e6, Math.max(1e-4, this.distance * factor)) / this.distance, box = this.canvas.getBoundingClientRect();
    if (event) this.pan((box.left + box.width / 2 - event.clientX) * (1 - nearer), (box.top + box.height / 2 - event.clientY) * (1 - nearer));
    this.distance *= nearer;
    this.changed();
  }
}
