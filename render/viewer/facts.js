// The facts of what is selected, its stages, and its history.

function make(tag, text, parent, name) {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  if (name) element.className = name;
  if (parent) parent.append(element);
  return element;
}
function table(rows, parent) {
  const list = make('dl', undefined, parent);
  for (const [name, value] of rows) {
    make('dt', name, list);
    make('dd', value, list);
  }
}
function button(text, more, parent, act) {
  const made = make('button', text, parent);
  made.type = 'button';  // in the form of the search, others search
  make('span', ' ' + more, made, 'quiet');
  made.addEventListener('click', act);
}

/** The example of a finding, then what to do. */
function explain({ said, is, remedy }, parent) {
  if (said || is) make('p', [said, is].filter(Boolean).join('; ') + '.', parent);
  if (remedy) make('p', 'Remedy: ' + remedy + '.', parent, 'quiet');
}

class Facts {
  /** `select` takes a selection, `css` gives the colour of a role. */
  constructor(panel, select, css) { Object.assign(this, { panel, select, css }); }

  /** `open`: the finding that is explained elsewhere on the page. */
  show(selection, frame, open) {
    this.open = open;
    const records = recordsOf(frame);
    this.frame = frame;
    this.panel.replaceChildren();
    if (selection && selection.body !== undefined) return this.body(selection.body, records);
    if (selection) return this.pair(selection, recordOf(selection.pair, frame));
    make('h2', 'This frame', this.panel);
    table([['pairs', digits(records.length)], ['points', digits(data.totals.points[frame])], ['deepest overlap', metres(data.totals.overlap[frame])]], this.panel);
    this.pairs('Deepest pairs', deepestOf(frame));
  }

  /** What lint says of what is selected, first of all: in this frame, or in which others. */
  lint(isOurs) {
    for (const finding of data.findings.filter(one => one !== this.open)) {
      const { what, index, at } = finding;
      const frames = new Set([...at].flatMap(([name, list]) => isOurs(name) ? [...list] : [])), others = frames.size - (frames.has(this.frame) ? 1 : 0);
      if (!frames.size) continue;
      const box = make('section', undefined, this.panel, 'finding'), more = others + ' more frame' + (others === 1 ? '' : 's');
      make('p', what, box);
      if (frames.has(this.frame)) make('p', others ? 'In this frame, and in ' + more + '.' : 'In this frame alone.', box, 'quiet');
      else make('p', 'Not in this frame: in frame ' + data.frames[Math.min(...frames)] + (others > 1 ? ' first, of ' + others : '') + '.', box, 'quiet');
      const own = finding.pair >= 0 ? namesInLint(finding.pair)[0] : '-1 ' + finding.body;
      if (index === this.frame && isOurs(own)) explain(finding, box);
    }
  }

  /** A button for each pair. */
  pairs(title, records) {
    make('p', title, this.panel, 'quiet');
    const list = make('ul', undefined, this.panel);
    for (const record of records.slice(0, 12)) {
      const pair = data.contacts.pair[record];
      button(pairName(pair), gapRow(data.contacts.separation[record]).join(' '), make('li', undefined, list), () => this.select({ pair }));
    }
    if (records.length > 12) make('li', 'and ' + (records.length - 12) + ' more', list, 'quiet');
  }

  /** A curve of values over the frames (NaN: none), with the frame shown. */
  history(name, words, values) {
    const known = values.filter(value => !Number.isNaN(value)), most = Math.max(...known), least = Math.min(0, ...known);
    if (!(most > least)) return;
    make('p', name + ' over frames, up to ' + words(most), this.panel, 'quiet');
    const canvas = Object.assign(make('canvas', undefined, this.panel, 'spark'), { width: 560, height: 80 }), pen = canvas.getContext('2d');
    pen.fillStyle = this.css('contacts');
    const x = at => 560 * at / Math.max(1, values.length - 1), y = value => 79 - 76 * (value - least) / (most - least);
    values.forEach((value, at) => Number.isNaN(value) || pen.fillRect(Math.floor(x(at)), y(value), Math.ceil(560 / values.length) + 1, 80 - y(value)));
    pen.fillStyle = this.css('text');
    pen.fillRect(x(this.frame) - 1, 0, 2.5, 80);
  }

  body(body, records) {
    const shape = data.shapes[body], pose = poseOf(body, this.frame), mass = data.masses[shape.body || shape.name], speed = frame => Math.hypot(...velocityOf(body, frame));
    make('h2', shape.name, this.panel);
    this.lint(name => name.split(' ').includes(String(body)));
    const rows = [['kind', shape.type], ['part of', shape.body], ['radius', shape.radius && metres(shape.radius)],
      ['margin', shape.margin && metres(shape.margin)], ['mass', mass && digits(mass) + ' kg']].filter(([, value]) => value);
    if (!pose) rows.push(['', 'not in this frame']);
    else rows.push(['position', vectorText(pose.slice(0, 3)) + ' m'], ['rotation', vectorText(pose.slice(3)) + ' w, x, y, z'],
      ['speed', digits(speed(this.frame)) + ' m/s, from the poses']);
    table(rows, this.panel);
    const own = records.filter(record => data.pairs[data.contacts.pair[record]].indexOf(body) in [0, 1]);
    this.pairs(own.length === 1 ? '1 pair' : own.length + ' pairs', own);
    this.history('speed', value => digits(value) + ' m/s', data.frames.map((_, frame) => speed(frame)));
  }

  pair({ pair, point }, record) {
    const { contacts, points } = data, of = data.frames.map((_, frame) => recordOf(pair, frame));
    make('h2', pairName(pair), this.panel);
    const names = namesInLint(pair);
    this.lint(name => names.includes(name));
    if (record < 0) {
      make('p', 'The pair has no contact in this frame.', this.panel);
    } else {
      const words = name => String(QUANTITIES[name](record) || '').replace(/_/g, ' '), normal = normalsOf(record)[0] ?? [NaN, NaN, NaN];
      // Kinds as lint has them: of what the shapes were, not of how they collide.
      table([['kind', data.pairs[pair].slice(0, 2).map(body => data.shapes[body].type).join('-')], ['state', contacts.state[record] ? 'touching' : 'separated'], gapRow(contacts.separation[record]), ['points', words('points') || '0'],
        ['normal', Number.isNaN(normal[0]) ? '' : vectorText(normal)], ['axis', words('axis')], ['type', words('type')]].filter(([, value]) => value), this.panel);
      eachPoint(record, (i, m) => this.point(i, m, record, { pair, point }));
      this.stages(stagesOf(record));
    }
    const over = quantity => of.map(at => at < 0 ? NaN : quantity(at));
    const ofPoint = column => over(at => ofPoints(at, i => pointKey(i, at) === point ? column[i] : NaN).find(value => !Number.isNaN(value)) ?? NaN);
    this.history(point ? 'overlap of the point' : 'overlap', metres, point ? ofPoint(points.separation).map(value => -value) : over(QUANTITIES.overlap));
    if (!point) this.history('points', digits, over(QUANTITIES.points));
    this.history(point ? 'impulse of the point' : 'impulse', newtonSeconds, point ? ofPoint(points.impulse) : over(QUANTITIES.impulse));
  }

  point(i, m, record, { pair, point }) {
    const { id, separation, impulse, friction } = data.points, key = pointKey(i, record), isChosen = key === point, box = make('section', undefined, this.panel, isChosen ? 'chosen' : '');
    button(pointName(i, m, record), gapRow(separation[i]).join(' '), box, () => this.select(isChosen ? { pair } : { pair, point: key }));
    if (!isChosen) return;
    const rows = [['id', data.texts[id[i]] || 'none'], gapRow(separation[i]), ['position', vectorText(positionOf(i)) + ' m']];
    if (!Number.isNaN(impulse[i])) rows.push(['impulse', newtonSeconds(impulse[i])], ['friction impulse', newtonSeconds(friction[i])]);
    if (data.manifolds.triangle[m] >= 0) rows.push(['triangle', String(data.manifolds.triangle[m])]);
    table(rows, box);
  }

  stages({ sat, clip, reduction, ...other }) {
    const axis = (name, one) => one ? [[name, gapRow(one.separation).join(' ')]] : [];
    const face = name => [name + ' face', (clip[name].face < 0 ? '' : clip[name].face + ' of ') + clip[name].shape + ', ' + clip[name].polygon.length + ' corners'];
    const rows = sat ? [...axis('best face of a', sat.face_a), ...axis('best face of b', sat.face_b), ...axis('best edges', sat.edge), ['chosen', sat.chosen.replace(/_/g, ' ')]] : [];
    if (clip) rows.push(face('reference'), face('incident'), ...clip.steps.slice(-1).map(step => ['clip polygon', step.polygon.length + ' corners after ' + clip.steps.length + ' side planes']),
      ...clip.dropped.map(point => ['dropped', vectorText(point.position) + ' ' + point.reason]));
    if (reduction) rows.push(['candidates', String(reduction.points.length)], ['kept', reduction.kept.join(', ') + ' by ' + reduction.method]);
    if (rows.length) make('h3', 'Stages', this.panel);
    table(rows, this.panel);
    for (const [name, facts] of Object.entries(other)) {
      const details = make('details', undefined, this.panel);
      make('summary', name.replace(/_/g, ' '), details);
      make('pre', JSON.stringify(facts, (_, x) => typeof x === 'number' ? Number(x.toPrecision(4)) : x, 1), details);
    }
  }
}
