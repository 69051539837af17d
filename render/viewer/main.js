// The page: state, drawing, picking, keys, the link's hash.

const ROOM = 1.1;   // around all bodies
const LISTED = 500;  // records that a search lists
const AROUND = 8;   // every other frame before and after, for a camera that moves smoothly

/** Delays the page's load event, for programs that wait for it to take a picture. Returns how to end that. */
function notLoaded() {
  const frame = Object.assign(make('iframe', undefined, document.body), { hidden: true });
  frame.contentDocument.open();
  return () => {
    frame.contentDocument.close();
    frame.remove();
  };
}

async function start() {
  const [fixed, others] = unpacked(takeText('facts_data'), document.currentScript.textContent);
  const three = inflate(takeText('three'));
  let canvas = byId('view'), context = canvas.getContext('webgl', { alpha: false, antialias: false });
  const driver = context && context.getExtension('WEBGL_debug_renderer_info');
  // Without a GPU smooth edges would take most of the time.
  if (!driver || !/swiftshader|llvmpipe|software/i.test(context.getParameter(driver.UNMASKED_RENDERER_WEBGL))) {
    canvas.replaceWith(canvas = canvas.cloneNode());
    context = canvas.getContext('webgl', { alpha: false });
  }
  make('script', new TextDecoder().decode(await three), document.head);
  data = await fixed;
  const scene = new THREE.Scene(), renderer = new THREE.WebGLRenderer({ canvas, context });
  renderer.debug.checkShaderErrors = false;
  PIXELS.value = new THREE.Vector2(1, 1);
  const bodies = new Bodies(scene, data.shapes.length > 12), layers = new Layers(scene, bodies);
  renderer.compile(scene, new THREE.PerspectiveCamera());
  Object.assign(data, await others);
  layers.measure();
  nameFindings();
  // Layers of stages are only there with the stages.
  const stage = { reference_face: 'clip', side_planes: 'clip', clip_polygons: 'clip', dropped: 'clip', incident_face: 'clip', candidates: 'reduction', reduced: 'reduction' };
  data.layers = data.layers.filter(({ name }) => !stage[name] || data.forms.some(form => form[stage[name]]));
  byId('source').textContent = [data.header.source, [data.header.engine, data.header.version].filter(Boolean).join(' '), data.command].filter(Boolean).join(' \u00b7 ');

  const usual = data.layers.filter(layer => layer.on).map(layer => layer.name).join(), { contacts, manifolds } = data, count = (n, word) => n + ' ' + word + (n === 1 ? '' : 's');
  // A selection: { body }, { pair } or { pair, point }, with numbers of bodies and pairs and the key of a point.
  const state = { frame: 0, selection: null, finding: -1, on: new Set(), find: '', theme: '', follow: -1 };
  let found = [], foundRecords = new Set(), hits = [], next = 0, dirty = true, labels = [], note = [], pending = 0;
  // Where the page begins without a finding: at the deepest overlap.
  const best = Math.max(0, [data.totals.overlap, data.totals.points].map(list => list.indexOf(Math.max(1e-300, ...list))).find(at => at >= 0) ?? 0);

  // ---- Drawing

  const dark = matchMedia('(prefers-color-scheme: dark)'), theme = () => state.theme || (dark.matches ? 'dark' : 'light'), css = role => data[theme()][role];
  const orbit = new Orbit(canvas, data.header.up === 'z', () => { view = 'free'; dirty = true; link(); });
  const facts = new Facts(byId('facts'), select, css), timeline = new Timeline(byId('timeline'), go, css);

  function ink() {
    document.documentElement.dataset.theme = theme();
    for (const [role, hex] of Object.entries(data[theme()])) {
      color.set(role, new THREE.Color(hex).toArray());
      document.documentElement.style.setProperty('--' + role, hex);
    }
  }
  function paint() {
    ink();
    refresh();
  }

  // ---- The camera, until the user moves it: on all bodies ('all'), on what is selected ('selection'), or as the user left it ('free')

  const views = new Map();
  let view = 'all', viewsFrom = '';
  /** As in the picture in a small scene, but wide enough for its bodies. In a heap what frames this one and those around it need, so that it moves smoothly. */
  function viewOfAll(frame) {
    const from = [orbit.yaw, orbit.pitch, orbit.aspect].join(), last = data.frames.length - 1;
    if (from !== viewsFrom) views.clear();
    viewsFrom = from;
    if (data.camera && !bodies.opaque) {
      const { eye, forward, height, perspective } = data.camera, spheres = bodies.heap(best);
      const depth = orbit.viewOf(spheres, 1).target.sub(point3(eye)).dot(point3(forward)), target = point3(eye).addScaledVector(point3(forward), depth);
      const drawn = 1.15 * height * (perspective ? depth : 1) / (2 * Math.tan(FIELD / 2)), needed = orbit.viewOf(bodies.outline(data.shapes.map((_, body) => body), -1), 1.1, target).distance;
      if (depth > 0) return { target, distance: Math.max(drawn, Math.min(needed, 2 * drawn)) };
    }
    const of = at => {
      if (!views.has(at)) views.set(at, orbit.viewOf(bodies.heap(at), ROOM));
      return views.get(at);
    };
    const near = Array.from({ length: 2 * AROUND + 1 }, (_, i) => frame + 2 * (i - AROUND)).filter(at => at >= 0 && at <= last).map(of).filter(one => one.distance > 0);
    if (!near.length) return { target: orbit.target.clone(), distance: orbit.distance };
    const target = near.reduce((sum, one) => sum.addScaledVector(one.target, 1 / near.length), new THREE.Vector3()), mean = near.reduce((sum, one) => sum + one.distance, 0) / near.length;
    return { target, distance: Math.max(mean, orbit.viewOf(bodies.heap(frame), ROOM, target).distance) };
  }
  const chosen = () => !state.selection ? [] : state.selection.pair === undefined ? [state.selection.body] : data.pairs[state.selection.pair].slice(0, 2);
  const recordOfSelection = () => state.selection && state.selection.pair !== undefined ? recordOf(state.selection.pair, state.frame) : -1;
  /** Frames the bodies that are selected, with as much around them. */
  function lookAtSelection() {
    bodies.place(state.frame);
    const places = bodies.outline(chosen(), recordOfSelection());
    view = places.length ? 'selection' : 'all';
    if (places.length) Object.assign(orbit, orbit.viewOf(places, state.selection.pair === undefined ? 3 : 1.7));
    if (!(orbit.distance > 0)) orbit.distance = bodies.size;
  }
  function fit() {
    if (data.camera) orbit.lookFrom(data.camera.forward.map(x => -x));
    if (state.selection && view !== 'selection') lookAtSelection();
    else view = 'all';
    refresh();
  }

  function refresh() {
    const { frame, selection } = state, finding = data.findings[state.finding];
    bodies.place(frame);
    if (view === 'all') Object.assign(orbit, viewOfAll(frame));
    const { flown, middle } = (bodies.heap(frame), bodies);
    bodies.open(chosen(), recordOfSelection(), middle, finding?.marked[frame].find(mark => mark.at)?.at);
    bodies.draw(state.on.has('shapes'), new Set(chosen()));
    labels = layers.draw(frame, state.on, selection, foundRecords, finding);
    facts.show(selection, frame, finding);
    timeline.draw(frame, found, finding);
    showHit();
    const title = data.titles[frame] || data.title;
    document.title = finding ? finding.what + ' \u00b7 ' + title : title;
    byId('title').textContent = finding ? finding.what : title;
    const elsewhere = !finding || frame === finding.index ? '' : finding.marked[frame].length ? 'Also in this frame. First: ' : 'Not in this frame. First: ';
    byId('said').textContent = finding ? elsewhere + [finding.where_words, [finding.said, finding.is].filter(Boolean).join('; ')].filter(Boolean).join(': ') : '';
    items.forEach((item, i) => { item.hidden = i !== state.finding; });
    byId('ringed').hidden = !layers.marks.length;
    byId('moment').textContent = 'frame ' + data.frames[frame] + ', ' + data.times[frame].toFixed(3) + ' s';
    note = [layers.crowd ? 'larger dots: deeper overlap' : layers.factor > 1 && data.totals.overlap[frame] ? 'lines of overlap: \u00d7 ' + layers.factor : '',
      layers.hasOther ? 'grey arrow: the normal that the shapes have there' : '', layers.hasFit ? 'grey dashes: the size that the contacts fit' : '', state.follow >= 0 ? 'following ' + data.shapes[state.follow].name : '', view === 'all' && flown ? flown + (flown > 1 ? ' bodies are' : ' body is') + ' far off' : ''];
    for (const box of byId('layers').querySelectorAll('input')) box.checked = state.on.has(box.value);
    byId('follow').disabled = !selection || selection.body === undefined;
    byId('follow').setAttribute('aria-pressed', state.follow >= 0);
    dirty = true;
    link();
  }

  function onScreen(at) {
    const { x, y, z } = point3(at).project(orbit.camera);
    return [(x + 1) / 2 * canvas.clientWidth, (1 - y) / 2 * canvas.clientHeight, z];
  }
  const ruler = document.createElement('canvas').getContext('2d'), widths = new Map();
  /** Beside its place, where a label covers no other one and no dot; what finds no such place is left out, unless it is important. */
  function showLabels() {
    const taken = [], parent = byId('labels'), [wide, high] = [canvas.clientWidth, canvas.clientHeight], { array } = layers.dots.object.geometry.attributes.position;
    const dots = Array.from({ length: labels.length ? Math.min(2000, layers.dots.rows) : 0 }, (_, i) => onScreen(array.subarray(3 * i, 3 * i + 3)));
    ruler.font = '14px Roboto, system-ui, sans-serif';
    const boxOf = ([x, y], width, away) => [[x + away, y - 20], [x + away, y + 2], [x - away - width, y - 20], [x - away - width, y + 2], [x - width / 2, y - away - 20], [x - width / 2, y + away],
      [x + away + 24, y - 42], [x - away - 24 - width, y - 42]];
    while (parent.children.length < labels.length) make('span', '', parent);
    [...parent.children].forEach((element, i) => {
      const label = labels[i], place = label && onScreen(label.at);
      element.hidden = !label || !label.text || place[2] > 1 || place[0] < 0 || place[0] > wide || place[1] < 0 || place[1] > high;
      if (element.hidden) return;
      if (!widths.has(label.text)) widths.set(label.text, ruler.measureText(label.text).width + 2);
      const width = widths.get(label.text);
      const fits = ([left, top]) => left > 4 && left + width < wide - 4 && top > 2 && top + 20 < high - 4 && !taken.some(([x, y, w]) => left < x + w + 4 && x < left + width + 4 && Math.abs(top - y) < 19);
      const covered = ([left, top]) => dots.filter(([x, y]) => x > left - 7 && x < left + width + 7 && y > top - 5 && y < top + 25).length;
      const free = boxOf(place, width, label.away || 12).filter(fits).map((box, order) => [box, covered(box), order]).sort((a, b) => a[1] - b[1] || a[2] - b[2])[0];
      element.hidden = !free || free[1] > 0 && label.isSmall;
      if (element.hidden) return;
      taken.push([...free[0], width]);
      element.textContent = label.text;
      Object.assign(element.style, { color: css(label.role), transform: 'translate(' + free[0][0] + 'px,' + free[0][1] + 'px)' });
    });
  }
  function draw(now) {
    requestAnimationFrame(draw);
    if (next && now >= next) {
      const frame = (state.frame + 1) % data.frames.length;
      next = now + Math.min(500, Math.max(0, 1000 * (data.times[frame] - data.times[state.frame]) - Math.min(16, now - next)));
      if (frame) show(frame);
      else play(false);
    }
    if (!dirty) return;
    dirty = false;
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.floor(wide * devicePixelRatio) || canvas.height !== Math.floor(high * devicePixelRatio)) renderer.setSize(Math.floor(wide * devicePixelRatio), Math.floor(high * devicePixelRatio), false);
    PIXELS.value.set(wide, high);
    orbit.place(wide, high, bodies.reach);
    const isCut = bodies.cut(orbit.camera.position);
    byId('words').textContent = [layers.marks.length ? '' : null, ...note, !state.on.has('shapes') ? '' : isCut ? 'walls in front are cut away' : windowed.value.w > 0 ? 'bodies in front are cut open' : ''].filter((words, i) => words || words === '' && !i).join(' \u00b7 ');
    bodies.sort(orbit.camera.position);
    renderer.setClearColor(new THREE.Color(css('ground')));
    renderer.render(scene, orbit.camera);
    showLabels();
  }

  // ---- Frames

  function show(frame) {
    const moved = state.follow >= 0 ? state.follow : view === 'selection' ? bodies.bySize(chosen())[0] ?? -1 : -1;
    const [now, then] = moved < 0 ? [] : [frame, state.frame].map(at => poseOf(moved, at));
    if (now && then) orbit.target.add(point3(now)).sub(point3(then));
    state.frame = frame;
    refresh();
  }
  function go(frame) {
    play(false);
    show(Math.min(data.frames.length - 1, Math.max(0, frame)));
  }
  function play(on) {
    if (on && state.frame === data.frames.length - 1) show(0);
    next = on ? performance.now() : 0;
    byId('play').setAttribute('aria-pressed', on);
    byId('play').textContent = on ? '\u275a\u275a' : '\u25b6\ufe0e';
  }

  // ---- Selecting

  /** Closes a finding that is not about the same pair. */
  function select(selection) {
    if (!selection || selection.pair === undefined || selection.pair !== state.selection?.pair) state.finding = -1;
    if (!selection && view === 'selection') view = 'all';
    state.selection = selection;
    if (state.follow >= 0) state.follow = selection ? selection.body ?? -1 : -1;
    refresh();
  }
  function follow() {
    state.follow = state.follow < 0 && state.selection ? state.selection.body ?? -1 : -1;
    const pose = state.follow < 0 ? null : poseOf(state.follow, state.frame);
    if (pose) [view, orbit.target] = ['free', point3(pose)];
    refresh();
  }
  /** The nearest point within reach, else the body under the pointer; null without one. `at`: where it is. */
  function pick(event) {
    const box = canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top, raycaster = new THREE.Raycaster();
    let best = null, least = event.pointerType === 'touch' ? 22 : 12;
    for (const record of state.on.has('contacts') ? recordsOf(state.frame) : [])
      eachPoint(record, i => {
        const [px, py, pz] = onScreen(positionOf(i)), away = Math.hypot(px - x, py - y);
        if (pz > 1 || away >= least) return;
        least = away;
        best = { what: { pair: contacts.pair[record], point: pointKey(i, record) }, at: positionOf(i) };
      });
    if (best || !state.on.has('shapes')) return best;
    raycaster.setFromCamera(new THREE.Vector2(2 * x / box.width - 1, 1 - 2 * y / box.height), orbit.camera);
    const body = bodies.hit(raycaster);
    return body < 0 ? null : { what: { body }, at: poseOf(body, state.frame) };
  }
  canvas.addEventListener('pointerup', event => {
    if (!orbit.moved && event.button === 0) select((pick(event) || { what: null }).what);
  });
  canvas.addEventListener('dblclick', event => {
    const hit = pick(event);
    if (hit) orbit.target.copy(point3(hit.at));
    orbit.zoom(0.6);
  });

  // ---- Search and findings

  /** Marks what is shown in the list of what was found, and scrolls there. */
  function showHit() {
    const list = byId('hits'), { body, pair } = state.selection || {};
    const shown = hits.slice(0, list.children.length).findIndex(hit => hit[3] === undefined ? hit[0] === state.frame && hit[2] === pair : hit[3] === body);
    [...list.children].forEach((item, i) => i === shown ? item.setAttribute('aria-current', 'true') : item.removeAttribute('aria-current'));
    if (shown < 0) return;
    const { offsetTop, offsetHeight } = list.children[shown], top = offsetTop - list.offsetTop;
    if (top < list.scrollTop || top + offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top - list.clientHeight / 2;
  }
  /** Shows a frame with its selection framed, and a finding. */
  function aim(frame, selection, finding) {
    play(false);
    Object.assign(state, { frame, selection, finding, follow: -1 });
    lookAtSelection();
    refresh();
  }
  function openFinding(i) {
    const { index, pair, body } = data.findings[i];
    byId('findings').open = true;
    aim(index < 0 ? state.frame : index, pair >= 0 ? { pair } : body >= 0 ? { body } : null, i);
  }
  function search(text) {
    state.find = text;
    [found, foundRecords, hits] = [[], new Set(), []];
    byId('hits').replaceChildren();
    try {
      const named = bodiesNamed(text);
      if (named.length) {
        byId('found').textContent = named.length > 1 ? named.length + ' bodies' : '1 body';
        for (const body of named.slice(0, LISTED)) {
          hits.push([state.frame, , , body]);
          button(data.shapes[body].name, '', make('li', undefined, byId('hits')), () => aim(state.frame, { body }, -1));
        }
        return refresh();
      }
      hits = text.trim() ? findRecords(text) : [];
      found = [...new Set(hits.map(([frame]) => frame))];
      foundRecords = new Set(hits.map(([, record]) => record).filter(record => record >= 0));
      byId('found').textContent = text.trim() ? count(hits.length, 'record') + ' in ' + count(found.length, 'frame') : '';
      for (const [frame, , pair] of hits.slice(0, LISTED))
        button('frame ' + data.frames[frame] + ': ' + pairName(pair), '', make('li', undefined, byId('hits')), () => aim(frame, { pair }, -1));
      if (hits.length > LISTED) make('p', 'and ' + (hits.length - LISTED) + ' more; Find again goes on to them', byId('hits'), 'quiet');
    } catch (error) {
      byId('found').textContent = error.message;
    }
    refresh();
  }
  byId('search').addEventListener('submit', event => {
    event.preventDefault();
    // Like in an editor: a new search stays where it is if that is found, and the same one again goes on.
    const text = byId('expression').value, isNew = text !== state.find;
    search(text);
    const frame = found.find(at => at > state.frame || isNew && at === state.frame) ?? found[0] ?? state.frame, hit = hits.find(([at]) => at === frame);
    if (hit) aim(frame, hit[3] === undefined ? { pair: hit[2] } : { body: hit[3] }, -1);
  });
  byId('expression').title = 'A name of a body, or a condition. Words: ' + Object.keys(data.quantities).join(', ') + '; previous.points, of the frame before; lint, lint.pairs_flicker';
  byId('count').textContent = 'lint: ' + count(data.findings.length, 'finding');
  if (!data.findings.length) byId('findings').replaceWith(make('p', data.leaves_out ? 'lint: nothing else is wrong' : 'lint: nothing is wrong', undefined, 'quiet'));
  const items = data.findings.map((finding, i) => {
    const { what, of, count: times, where_words: where } = finding, item = make('li', undefined, byId('lint'), 'finding');
    const many = of ? times + ' of ' + of : times > 1 ? times + ' times' : '';
    button(what, [many, where].filter(Boolean).join(' \u00b7 '), item, () => openFinding(i));
    const more = make('div', undefined, item);
    explain(finding, more);
    return more;
  });

  // ---- The link's hash

  /** The index of a frame, or of the last one before it. */
  const nearestFrame = frame => Math.max(0, data.frames.findLastIndex(one => one <= frame));

  function hash() {
    const words = new URLSearchParams({ frame: data.frames[state.frame] }), { body, pair, point } = state.selection || {}, on = [...state.on].join();
    const all = { body: body !== undefined && data.shapes[body].name, pair: pair !== undefined && JSON.stringify(namesOf(pair)), point, layers: on !== usual && (on || 'none'),
      find: state.find, theme: state.theme, follow: state.follow >= 0 && '1', finding: state.finding + 1, camera: view === 'free' && [orbit.yaw, orbit.pitch, orbit.distance, ...orbit.target.toArray()].map(x => Number(x.toPrecision(5))).join() };
    for (const [name, value] of Object.entries(all)) if (value) words.set(name, value);
    return '#' + words;
  }
  function link() {
    clearTimeout(pending);
    pending = setTimeout(() => history.replaceState(null, '', hash()), 250);
  }
  function read() {
    const words = new URLSearchParams(location.hash.slice(1)), get = name => words.get(name) || '', camera = get('camera').split(',').map(Number);
    const body = data.shapes.findIndex(shape => shape.name === get('body')), pair = data.pairs.findIndex((_, i) => JSON.stringify(namesOf(i)) === get('pair'));
    // A finding alone opens where it is.
    const finding = Number(get('finding')) - 1, there = data.findings[finding], isAlone = there && there.index >= 0 && !words.has('frame') && body < 0 && pair < 0;
    Object.assign(state, { theme: ['light', 'dark'].includes(get('theme')) ? get('theme') : '', frame: words.has('frame') ? nearestFrame(Number(get('frame'))) : isAlone ? there.index : best, finding,
      selection: body >= 0 ? { body } : pair >= 0 ? (get('point') ? { pair, point: get('point') } : { pair }) : !isAlone ? null : there.pair >= 0 ? { pair: there.pair } : { body: there.body },
      on: new Set((get('layers') || usual).split(',')), follow: body >= 0 && get('follow') ? body : -1 });
    if (data.camera) orbit.lookFrom(data.camera.forward.map(x => -x));
    view = 'all';
    orbit.aspect = canvas.clientWidth / canvas.clientHeight;
    if (state.selection) lookAtSelection();
    if (camera.length === 6 && camera.every(Number.isFinite) && camera[2] > 0) {
      view = 'free';
      [orbit.yaw, orbit.pitch, orbit.distance] = camera;
      orbit.target.fromArray(camera, 3);
    }
    byId('expression').value = get('find');
    ink();
    search(get('find'));
  }
  addEventListener('hashchange', read);
  addEventListener('resize', () => {
    orbit.aspect = canvas.clientWidth / canvas.clientHeight;
    refresh();
  });
  dark.addEventListener('change', paint);

  // ---- Buttons and keys

  const swatch = { shapes: 'shape_a', center_of_mass: 'text', candidates: 'dropped', reduced: 'contacts', ids: 'text', names: 'text' };
  data.layers.forEach(({ name, words }, i) => {
    const label = make('label', undefined, byId('layers')), box = Object.assign(make('input', undefined, label), { type: 'checkbox', value: name });
    make('i', undefined, label).style.background = 'var(--' + (swatch[name] || name) + ')';
    make('span', words, label);
    if (i < 9) make('kbd', String(i + 1), label);
    box.addEventListener('change', () => toggle(name));
  });
  function toggle(name) {
    state.on = new Set(data.layers.map(layer => layer.name).filter(one => state.on.has(one) !== (one === name)));
    refresh();
  }
  function turn() {
    state.theme = theme() === 'dark' ? 'light' : 'dark';
    paint();
  }
  const acts = { play: () => play(!next), back: () => go(state.frame - 1), next: () => go(state.frame + 1), theme: turn, fit, follow, help: () => byId('keys').showModal() };
  for (const [id, act] of Object.entries(acts)) byId(id).addEventListener('click', act);
  const keys = { ' ': acts.play, Home: () => go(0), End: () => go(data.frames.length - 1), f: follow, r: fit, t: turn, '?': acts.help, Escape: () => select(null),
    '/': () => byId('expression').focus() };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.altKey || event.metaKey || byId('keys').open || event.target.type === 'search' || event.target.tagName === 'BUTTON' && event.key === ' ') return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key, way = { ArrowLeft: -1, ArrowRight: 1 }[key], layer = data.layers[key - 1];
    if (way) go(state.frame + way * (event.shiftKey ? 10 : 1));
    else if (keys[key]) keys[key]();
    else if (layer && key <= '9') toggle(layer.name);
    else return;
    event.preventDefault();
  });

  const isFresh = !location.hash;
  byId('findings').open = isFresh || /[#&]finding=/.test(location.hash);
  read();
  const first = data.findings.findIndex(({ index }) => index >= 0);
  if (isFresh && first >= 0) openFinding(first);
  requestAnimationFrame(draw);
  window.contactscope = { data, state, orbit, layers, bodies, quantities: Object.keys(QUANTITIES), hash, onScreen, select, search, go, stagesOf, draw: () => { dirty = true; } };  // for tests and the console
  document.documentElement.dataset.ready = 'yes';
  performance.mark('ready');
}

function fail(error) {
  byId('title').textContent = 'This page needs WebGL and a browser of 2023 or later: ' + error.message;
  document.documentElement.dataset.ready = 'no';
}
if (self.document) {
  const loaded = notLoaded();
  start().catch(fail).finally(() => requestAnimationFrame(() => requestAnimationFrame(loaded)));
} else onmessage = event => unpack(event.data, postMessage).catch(error => postMessage(failureOf(error)));
})();
