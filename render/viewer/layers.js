// The layers of a frame, from its facts: what pictures show, in the same colours and forms.

const CROWD = 30;  // above so many manifolds points show their depth by size, and normals are left out

class Layers {
  constructor(scene, bodies) {
    Object.assign(this, { bodies, fills: new Fills(), lines: new Lines(4), dots: new Dots(scene) });
    scene.add(this.fills.object, this.lines.object);
  }

  /** Once the contacts are there. */
  measure() {
    const { bodies } = this;
    this.deepest = Math.max(...data.totals.overlap);
    // Lines of overlap are longer by a round factor, so that the deepest is up to a tenth of a typical body.
    const exact = this.deepest > 0 ? bodies.size / 10 / this.deepest : 1;
    this.factor = exact < 2 ? 1 : [1, 2, 5].map(step => step * 10 ** Math.floor(Math.log10(exact))).filter(step => step <= exact).pop();
    this.strongest = data.points.impulse.reduce((most, impulse) => Math.max(most, impulse || 0), 0);
  }

  /** Fills lines, dots and polygons. Returns labels: { at, text, role }, the most important first. `on`: layers; `found`: records to mark; `finding`: the one that is open. */
  draw(frame, on, selection, found, finding) {
    const { lines, dots, fills, bodies } = this, { contacts, manifolds, points } = data, ink = role => color.get(role), worst = data.totals.worst[frame];
    const labels = this.labels = [];
    this.hasOther = this.hasFit = false;
    for (const marks of [lines, dots, fills]) marks.rows = 0;
    this.drawFinding(frame, finding);
    this.drawBodies(frame, on, selection);
    this.crowd = contacts.manifolds[contacts.first[frame + 1]] - contacts.manifolds[contacts.first[frame]] > CROWD;
    for (const record of recordsOf(frame)) {
      const chosen = selection && selection.pair === contacts.pair[record], few = !this.crowd || chosen;
      // No arrow is longer than the smaller body.
      const size = Math.min(bodies.size, ...data.pairs[contacts.pair[record]].slice(0, 2).map(body => bodies.sizes[body] || bodies.size));
      this.drawStages(stagesOf(record), on);
      for (let m = contacts.manifolds[record]; m < contacts.manifolds[record + 1]; ++m) {
        const normal = manifolds.normal.subarray(3 * m, 3 * m + 3), count = manifolds.first[m + 1] - manifolds.first[m], middle = [0, 0, 0];
        for (let i = manifolds.first[m]; i < manifolds.first[m + 1]; ++i) {
          const at = positionOf(i), overlap = Math.max(0, -points.separation[i]);
          for (let k = 0; k < 3; ++k) middle[k] += at[k] / count;
          if (on.has('contacts')) {
            const radius = few ? (overlap > 0 ? 6 : 4) : 1.8 + 5 * Math.sqrt(overlap / (this.deepest || 1));
            dots.add(at, ink('contacts'), DOT + (chosen ? STRONG : 0), radius);
            if (found.has(record)) dots.add(at, ink('finding'), RING, radius + 5);
            if (few && overlap > 0) lines.add(at, at.map((x, k) => x + normal[k] * overlap * this.factor), ink('contacts'), 2.5);
          }
          if (on.has('ids') && few) labels.push({ at, text: data.texts[points.id[i]], role: 'text', isSmall: true });
          if (on.has('impulses') && points.impulse[i] > 0)
            lines.arrow(at, normal, bodies.size * 0.8 * points.impulse[i] / this.strongest, ink('impulses'), few ? 2.5 : 1.5);
          if (chosen && pointKey(i, record) === selection.point) dots.add(at, ink('text'), RING + STRONG, 12);
        }
        const ringed = this.marks.find(mark => mark.point >= manifolds.first[m] && mark.point < manifolds.first[m + 1]);
        if (count && on.has('normals') && few) lines.arrow(ringed ? ringed.at : middle, normal, size * 0.45, ink('normals'), 2.5);
        if (chosen && ringed && ringed.normal) this.drawOtherNormal(ringed, normal, size * 0.45);
      }
    }
    if (worst >= 0 && on.has('contacts')) {
      dots.add(positionOf(worst), ink('contacts'), DOT, 8);
      dots.add(positionOf(worst), ink('text'), RING, 11);
      labels.unshift({ at: positionOf(worst), text: 'deepest: ' + metres(-points.separation[worst]), role: 'text' });
    }
    for (const { at, text } of this.marks) {
      dots.add(at, ink('text'), WIDE_RING + STRONG, 15);
      labels.unshift({ at, text, role: 'text', away: 18 });
    }
    for (const marks of [fills, lines, dots]) marks.flush();
    dots.look(bodies.size * 0.3, !this.crowd ? 0.9 : selection ? 0.12 : 0.3);
    return labels;
  }

  /** In grey, the normal that the shapes have where another one is reported, with the angle between them. */
  drawOtherNormal({ at, normal }, reported, length) {
    const angle = 2 * Math.asin(Math.min(1, chord(normal, reported) / Math.hypot(...normal) / 2)) * 180 / Math.PI;
    this.lines.arrow(at, normal, length, color.get('dropped'), 2.5);
    this.hasOther = true;
    this.labels.unshift({ at: at.map((x, k) => x + (normal[k] + reported[k]) * length * 0.4), text: angle.toFixed(0) + '\u00b0', role: 'text' });
  }

  /** The displacement of a body in a step, as in pictures. */
  drawStep(at, step) {
    const length = Math.hypot(...step);
    this.lines.arrow(at, step.map(x => x / length), length, color.get('velocities'), 3);
    this.labels.push({ at: at.map((x, k) => x + step[k] / 2), text: metres(length) + ' in a step', role: 'text' });
  }

  /** A body at the size that its contacts fit, as in pictures; of round ones nothing. */
  drawFit(body, scale) {
    const { vertices, faces = [], radius = 0 } = data.shapes[body], matrix = this.bodies.matrices[body];
    if (radius > 0) return;
    const corners = vertices.map(vertex => point3(vertex).multiplyScalar(scale).applyMatrix4(matrix).toArray());
    for (const face of faces) this.lines.loop(face.map(corner => corners[corner]), color.get('dropped'), 2, 6);
    this.hasFit = true;
  }

  /** The places that a finding names in a frame: as in pictures a wide ring, about the point, or the smaller body without one. */
  drawFinding(frame, finding) {
    const { bodies } = this, frames = recordsOf(frame);
    if (finding && finding.fits && finding.marked[frame].length) this.drawFit(...finding.fits);
    this.marks = (finding ? finding.marked[frame] : []).slice(0, 20).map(({ key, at, normal, step, from }) => {
      const both = key.split(' ').map(Number).filter(body => body >= 0), body = bodies.bySize(both)[0];
      const record = both.length < 2 ? undefined : frames.find(one => data.pairs[data.contacts.pair[one]].slice(0, 2).every(one => both.includes(one)));
      let nearest = null, least = Infinity;
      if (record !== undefined) eachPoint(record, (i, m) => {
        const far = at ? Math.hypot(...at.map((x, k) => x - positionOf(i)[k])) : data.points.separation[i];
        if (far < least) [least, nearest] = [far, { at: positionOf(i), point: i, normal, text: 'lint: ' + pointName(i, m, record) }];
      });
      if (step) this.drawStep(from, step);
      if (nearest && (!at || least < 0.02 * bodies.size)) return nearest;
      return { at: at || (body === undefined ? null : bodies.sphere(body).slice(0, 3)), text: 'lint' + (both.length === 1 ? ': ' + data.shapes[body].name : '') };
    }).filter(mark => mark.at);
  }

  drawStages({ clip, reduction }, on) {
    const { lines, dots, fills, labels } = this, ink = role => color.get(role), last = clip && clip.steps[clip.steps.length - 1];
    for (const [layer, face, dash] of clip ? [['reference_face', clip.reference, 0], ['incident_face', clip.incident, 7]] : []) {
      if (!on.has(layer)) continue;
      fills.polygon(face.polygon, ink(layer), 0.35);
      lines.loop(face.polygon, ink(layer), 3, dash);
    }
    if (clip && on.has('side_planes'))
      clip.reference.polygon.forEach((corner, i, all) => clip.steps[i] && lines.arrow(corner.map((x, k) => (x + all[(i + 1) % all.length][k]) / 2),
        clip.steps[i].plane.normal, this.bodies.size * 0.12, ink('side_planes'), 2));
    if (last && on.has('clip_polygons')) lines.loop(last.polygon, ink('clip_polygons'), 2.5);
    if (clip && on.has('dropped')) for (const point of clip.dropped) dots.add(point.position, ink('dropped'), CROSS, 5);
    if (reduction && on.has('candidates'))
      reduction.points.forEach((point, i) => dots.add(point.position, ink('dropped'), reduction.kept.includes(i) ? HOLLOW : CROSS, 5));
    if (!reduction || !on.has('reduced')) return;
    reduction.kept.forEach((kept, order) => {
      dots.add(reduction.points[kept].position, ink('contacts'), RING, 10);
      labels.push({ at: reduction.points[kept].position, text: String(order + 1), role: 'contacts' });
    });
  }

  /** A place on a plane next to the body that it is named with: its own origin may be within another body. */
  besideOn({ normal, offset }, plane, named) {
    const { bodies } = this, other = [...named].find(body => !data.shapes[body].half_space), matrix = bodies.matrices[plane];
    if (other === undefined) return null;
    const up = point3(normal).transformDirection(matrix), [x, y, z, radius] = bodies.sphere(other), middle = point3([x, y, z]);
    const foot = middle.clone().addScaledVector(up, -middle.clone().sub(point3(normal.map(c => c * offset)).applyMatrix4(matrix)).dot(up));
    const side = point3(Math.abs(up.x) < 0.8 ? [1, 0, 0] : [0, 1, 0]).cross(up).normalize();
    return foot.addScaledVector(side, 1.5 * (radius || bodies.size)).toArray();
  }

  drawBodies(frame, on, selection) {
    const { bodies, dots, lines } = this, { contacts } = data;
    // In a heap only those of which the page speaks.
    const pair = record => data.pairs[contacts.pair[record]].slice(0, 2), named = new Set(!selection ? [] : selection.pair === undefined ? [selection.body] : data.pairs[selection.pair].slice(0, 2));
    if (on.has('names'))
      for (const body of data.shapes.length <= 12 ? data.shapes.keys() : deepestOf(frame).flatMap(pair)) named.add(body);
    data.shapes.forEach((shape, body) => {
      if (!bodies.here[body]) return;
      const at = point3(shape.center_of_mass || [0, 0, 0]).applyMatrix4(bodies.matrices[body]).toArray();
      if (on.has('center_of_mass') && !shape.half_space && shape.type !== 'mesh') {
        dots.add(at, color.get('text'), DOT, 5);
        dots.add(at, color.get('ground'), DOT, 1);
      }
      const velocity = on.has('velocities') ? velocityOf(body, frame) : [0, 0, 0], speed = Math.hypot(...velocity);
      if (speed > 1e-3) lines.arrow(at, velocity.map(x => x / speed), Math.min(2 * bodies.size, speed * 0.15), color.get('velocities'), 2.5);
      if (named.has(body)) this.labels.push({ at: shape.half_space ? this.besideOn(shape.half_space, body, named) || at : at, text: shape.name, role: 'text' });
    });
  }
}
