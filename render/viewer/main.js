// The page: state, drawing, picking, keys, the link's hash.

async function start() {
  const [fixed, others] = unpacked(takeText('facts_data'), document.currentScript.textContent);
  let canvas = byId('view'), context = canvas.getContext('webgl', { alpha: false, antialias: false });
  const driver = context && context.getExtension('WEBGL_debug_renderer_info');
  // Without a GPU smooth edges would take most of the time.
  if (!driver || !/swiftshader|llvmpipe|software/i.test(context.getParameter(driver.UNMASKED_RENDERER_WEBGL))) {
    canvas.replaceWith(canvas = canvas.cloneNode());
    context = canvas.getContext('webgl', { alpha: false });
  }
  make('script', new TextDecoder().decode(await inflate(takeText('three'))), document.head);
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
  const state = { frame: 0, selection: null, on: new Set(), find: '', theme: '', follow: -1 };
  let found = [], foundRecords = new Set(), next = 0, dirty = true, labels = [], pending = 0;

  // ---- Drawing

  const dark = matchMedia('(prefers-color-scheme: dark)'), theme = () => state.theme || (dark.matches ? 'dark' : 'light'), css = role => data[theme()][role];
  const orbit = new Orbit(canvas, data.header.up === 'z', () => { dirty = true; link(); });
  const facts = new Facts(byId('facts'), select, css), timeline = new Timeline(byId('timeline'), go, css);

  function paint() {
    document.documentElement.dataset.theme = theme();
    for (const [role, hex] of Object.entries(data[theme()])) {
      color.set(role, new THREE.Color(hex).toArray());
      document.documentElement.style.setProperty('--' + role, hex);
    }
    refresh();
  }

  /** Looks at where contacts are, else at bodies: their median, and twice as far as half of them are from it. */
  function fit() {
    const busiest = data.totals.points[state.frame] ? state.frame : data.totals.points.indexOf(Math.max(...data.totals.points)), places = [];
    bodies.place(busiest);
    for (const record of recordsOf(busiest)) eachPoint(record, i => places.push(positionOf(i)));
    if (!places.length) bodies.here.forEach((here, body) => here && places.push(bodies.matrices[body].elements.slice(12, 15)));
    const median = list => list.sort((a, b) => a - b)[list.length >> 1] || 0, middle = [0, 1, 2].map(k => median(places.map(place => place[k])));
    const spread = median(places.map(place => Math.hypot(...middle.map((x, k) => place[k] - x))));
    orbit.target.set(...middle);
    bodies.subject.value.set(...middle);
    orbit.distance = Math.max(2 * spread, bodies.size * 0.8) / Math.tan(FIELD / 2);
    if (data.camera) {
      const { eye, forward, height, perspective } = data.camera, depth = orbit.target.clone().sub(point3(eye)).dot(point3(forward));
      orbit.lookFrom(forward.map(x => -x));
      if (!bodies.opaque && depth > 0) {  // as in the picture
        orbit.target.copy(point3(eye)).addScaledVector(point3(forward), depth);
        orbit.distance = 1.15 * height * (perspective ? depth : 1) / (2 * Math.tan(FIELD / 2));
      }
    }
    refresh();
  }

  function refresh() {
    const { frame, selection } = state, chosen = !selection ? [] : selection.pair === undefined ? [selection.body] : data.pairs[selection.pair].slice(0, 2);
    bodies.place(frame);
    bodies.open(chosen, selection && selection.pair !== undefined ? recordOf(selection.pair, frame) : -1);
    bodies.draw(state.on.has('shapes'), new Set(chosen));
    labels = layers.draw(frame, state.on, selection, foundRecords);
    facts.show(selection, frame);
    timeline.draw(frame, found);
    document.title = byId('title').textContent = data.titles[frame] || data.title;
    byId('moment').textContent = 'frame ' + data.frames[frame] + ', ' + data.times[frame].toFixed(3) + ' s';
    byId('note').textContent = [layers.crowd ? 'larger dots: deeper overlap' : layers.factor > 1 && data.totals.overlap[frame] ? 'lines of overlap: \u00d7 ' + layers.factor : '',
      state.follow >= 0 ? 'following ' + data.shapes[state.follow].name : ''].filter(Boolean).join(' \u00b7 ');
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
  function showLabels() {
    const taken = [], parent = byId('labels');
    while (parent.children.length < labels.length) make('span', '', parent);
    [...parent.children].forEach((element, i) => {
      const label = labels[i], [x, y, z] = label ? onScreen(label.at) : [], wide = label ? label.text.length * 8 : 0;
      element.hidden = !label || z > 1 || taken.some(other => Math.abs(other.x - x) < (other.wide + wide) / 2 && Math.abs(other.y - y) < 17);
      if (element.hidden) return;
      taken.push({ x, y, wide });
      element.textContent = label.text;
      Object.assign(element.style, { color: css(label.role), transform: 'translate(' + (x + 12) + 'px,' + (y - 22) + 'px)' });
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
    bodies.sort(orbit.camera.position);
    renderer.setClearColor(new THREE.Color(css('ground')));
    renderer.render(scene, orbit.camera);
    showLabels();
  }

  // ---- Frames

  function show(frame) {
    const [now, then] = state.follow < 0 ? [] : [frame, state.frame].map(at => poseOf(state.follow, at));
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

  function select(selection) {
    state.selection = selection;
    if (state.follow >= 0) state.follow = selection ? selection.body ?? -1 : -1;
    refresh();
  }
  function follow() {
    state.follow = state.follow < 0 && state.selection ? state.selection.body ?? -1 : -1;
    const pose = state.follow < 0 ? null : poseOf(state.follow, state.frame);
    if (pose) orbit.target.copy(point3(pose));
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

  function jump(list, frame, selection, text, more) {
    button(text, more, make('li', undefined, list), () => {
      if (selection) state.selection = selection;
      // The camera turns about the body, or the smaller one of the pair.
      const both = !selection ? [] : selection.pair === undefined ? [selection.body] : data.pairs[selection.pair].slice(0, 2);
      const pose = both.sort((a, b) => bodies.sizes[a] - bodies.sizes[b]).map(body => poseOf(body, frame)).find(Boolean);
      if (pose) orbit.target.copy(point3(pose));
      go(frame);
    });
  }
  function search(text) {
    state.find = text;
    [found, foundRecords] = [[], new Set()];
    byId('hits').replaceChildren();
    try {
      const hits = text.trim() ? findRecords(text) : [];
      found = [...new Set(hits.map(([frame]) => frame))];
      foundRecords = new Set(hits.map(([, record]) => record).filter(record => record >= 0));
      byId('found').textContent = text.trim() ? count(hits.length, 'record') + ' in ' + count(found.length, 'frame') : '';
      for (const [frame, , pair] of hits.slice(0, 100)) jump(byId('hits'), frame, { pair }, 'frame ' + data.frames[frame] + ': ' + pairName(pair), '');
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
    if (found.length) go(found.find(frame => frame > state.frame || isNew && frame === state.frame) ?? found[0]);
  });
  byId('expression').title = 'Words: ' + Object.keys(data.quantities).join(', ') + '; previous.points, of the frame before; lint, lint.pairs_flicker';
  byId('findings').hidden = !data.findings.length;
  byId('count').textContent = 'lint: ' + count(data.findings.length, 'finding');
  for (const { what, said, is, remedy, index, a, b, ...finding } of data.findings) {
    const many = finding.of ? ', ' + finding.count + ' of ' + finding.of : finding.count > 1 ? ', ' + finding.count + ' times' : '';
    const pair = data.pairs.findIndex((_, i) => [a, b].sort().join('\n') === namesOf(i).slice(0, 2).sort().join('\n'));
    const body = data.shapes.findIndex(shape => shape.name === a), place = index < 0 ? '' : ' \u00b7 frame ' + data.frames[index] + ': ' + [a, b].filter(Boolean).join(' and ');
    jump(byId('lint'), Math.max(0, index), pair >= 0 ? { pair } : body >= 0 ? { body } : null, what + many + place, [said, is, remedy].filter(Boolean).join('; '));
  }

  // ---- The link's hash

  function hash() {
    const words = new URLSearchParams({ frame: data.frames[state.frame] }), { body, pair, point } = state.selection || {}, on = [...state.on].join();
    const all = { body: body !== undefined && data.shapes[body].name, pair: pair !== undefined && JSON.stringify(namesOf(pair)), point, layers: on !== usual && (on || 'none'),
      find: state.find, theme: state.theme, follow: state.follow >= 0 && '1', camera: [orbit.yaw, orbit.pitch, orbit.distance, ...orbit.target.toArray()].map(x => Number(x.toPrecision(5))).join() };
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
    Object.assign(state, { theme: ['light', 'dark'].includes(get('theme')) ? get('theme') : '', frame: Math.max(0, data.frames.indexOf(Number(get('frame')))),
      selection: body >= 0 ? { body } : pair < 0 ? null : get('point') ? { pair, point: get('point') } : { pair },
      on: new Set((get('layers') || usual).split(',')), follow: body >= 0 && get('follow') ? body : -1 });
    paint();
    fit();
    if (camera.length === 6 && camera.every(Number.isFinite) && camera[2] > 0) {
      [orbit.yaw, orbit.pitch, orbit.distance] = camera;
      orbit.target.fromArray(camera, 3);
    }
    byId('expression').value = get('find');
    search(get('find'));
  }
  addEventListener('hashchange', read);
  addEventListener('resize', refresh);
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
  byId('findings').open = isFresh;
  read();
  if (isFresh && data.worst && data.findings.length) byId('lint').querySelector('button').click();
  requestAnimationFrame(draw);
  window.contactscope = { data, state, orbit, layers, bodies, quantities: Object.keys(QUANTITIES), hash, onScreen, select, search, go, stagesOf, draw: () => { dirty = true; } };  // for tests and the console
  document.documentElement.dataset.ready = 'yes';
}

function fail(error) {
  byId('title').textContent = 'This page needs WebGL and a browser of 2023 or later: ' + error.message;
  document.documentElement.dataset.ready = 'no';
}
if (self.document) start().catch(fail);
else onmessage = event => unpack(event.data, postMessage).catch(error => postMessage(failureOf(error)));
})();
