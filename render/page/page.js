'use strict';
// Player for the frames of a sequence. A frame is a list of groups of the picture; each distinct group is
// in this file once. To show a frame, its groups are put into the picture, in order.
(() => {
  const find = id => document.getElementById(id);
  const data = JSON.parse(find('data').textContent);
  const frames = data.frames;
  const groups = new Map();
  for (const group of document.querySelectorAll('#picture > g, #column > g, #store g[id]'))
    groups.set(Number(group.id.slice(1)), group);
  const picture = find('picture'), column = find('column'), facts = find('facts');
  const hidden = new Set();  // layers that are switched off
  let shown = 0;             // index of the frame
  let held = null;           // pinned by a click, { kind, key }
  let timer = 0;

  const make = (tag, text, parent) => {
    const element = document.createElement(tag);
    if (text !== undefined) element.textContent = text;
    if (parent) parent.append(element);
    return element;
  };

  // ---- Frames

  function show(place, told) {
    shown = Math.min(Math.max(place, 0), frames.length - 1);
    const frame = frames[shown];
    picture.replaceChildren(...frame.view.map(number => groups.get(number)));
    column.replaceChildren(...frame.panels.map(number => groups.get(number)));
    hide();
    if (frame.title) find('title').textContent = frame.title;
    find('moment').textContent = frame.moment;
    find('slider').value = shown;
    find('slider').setAttribute('aria-valuetext', frame.moment);
    for (const id of ['home', 'back']) find(id).disabled = shown === 0;
    for (const id of ['next', 'end']) find(id).disabled = shown === frames.length - 1;
    show_legend(frame);
    list_contacts(frame);
    hold(held);
    if (told) history.replaceState(null, '', '#frame=' + frame.frame);
  }

  function linked() {
    const match = /frame=(\d+)/.exec(location.hash);
    const place = match ? frames.findIndex(frame => frame.frame === Number(match[1])) : -1;
    return place < 0 ? null : place;
  }

  function play(on) {
    clearInterval(timer);
    timer = 0;
    find('play').setAttribute('aria-pressed', on);
    find('play').setAttribute('aria-label', on ? 'Stop' : 'Play');
    if (!on) return;
    if (shown === frames.length - 1) show(0, true);
    timer = setInterval(() => {
      show(shown + 1, true);
      if (shown === frames.length - 1) play(false);
    }, data.pause);
  }

  function go(place) {
    play(false);
    show(place, true);
  }

  // ---- Layers

  function hide() {
    for (const svg of [picture, column])
      for (const group of svg.children)
        group.style.display = hidden.has(group.dataset.layer) ? 'none' : '';
    const here = new Set(frames[shown].view.map(number => groups.get(number).dataset.layer));
    for (const label of find('layers').querySelectorAll('label[data-layer]'))
      label.classList.toggle('empty', !here.has(label.dataset.layer));
  }

  function switch_for(words, key, title, changed) {
    const label = make('label', undefined, find('layers'));
    const box = make('input', undefined, label);
    box.type = 'checkbox';
    box.checked = true;
    box.addEventListener('change', () => changed(box.checked));
    make('span', words, label);
    if (key) make('kbd', key, label).className = 'key';
    label.title = title + (key ? ' (key ' + key + ')' : '');
    return { label, box };
  }

  const layers = data.layers.map((layer, i) => {
    const { label, box } = switch_for(layer.words, i < 9 ? String(i + 1) : '', 'On or off: ' + layer.words, on => {
      hidden[on ? 'delete' : 'add'](layer.name);
      hide();
      point_at(null);
    });
    label.dataset.layer = layer.name;
    return box;
  });
  let panels = null;
  if (data.panels) {
    panels = switch_for('panels', 'p', 'On or off: the panels next to the view', on => {
      find('panels').hidden = !on;
      find('stage').classList.toggle('alone', !on);
    }).box;
  } else {
    find('panels').hidden = true;
    find('stage').classList.add('alone');
  }
  find('layers').hidden = data.layers.length === 0 && !data.panels;
  const flip = box => {
    if (box) box.click();
  };

  // ---- Legend

  function show_legend(frame) {
    const list = find('legend');
    if (list.dataset.shown === String(frame.legend)) return;
    list.dataset.shown = String(frame.legend);
    list.replaceChildren();
    for (const number of frame.legend) {
      const entry = data.legend[number];
      const item = make('li', undefined, list);
      item.innerHTML = entry.sign;
      make('span', entry.text, item);
    }
  }

  // ---- Facts of the object under the pointer

  const places = { point: 'points', face: 'faces', pair: 'pairs' };

  // Facts with this key in the current frame. Keys are the same in all frames, so a pinned object stays pinned.
  function said(what) {
    if (!what) return null;
    return frames[shown][places[what.kind]].find(one => one.key === what.key) || null;
  }

  function inside(polygon, x, y) {
    let within = false;
    for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
      const [ax, ay] = polygon[i], [bx, by] = polygon[j];
      if (ay > y !== by > y && x < (bx - ax) * (y - ay) / (by - ay) + ax) within = !within;
    }
    return within;
  }

  // The nearest point, else the face under the pointer, else the pair whose symbol is there.
  function found_at(event) {
    const frame = frames[shown];
    const matrix = picture.getScreenCTM();
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    const reach = Math.max(11, (event.pointerType === 'touch' ? 20 : 10) / matrix.a);
    let best = null, least = reach;
    for (const point of frame.points) {
      const away = Math.hypot(point.x - at.x, point.y - at.y);
      if (away < least && point.layers.some(layer => !hidden.has(layer))) {
        best = { kind: 'point', key: point.key };
        least = away;
      }
    }
    if (best) return best;
    const group = event.target.closest ? event.target.closest('#picture > g') : null;
    const layer = group ? group.dataset.layer : '';
    const face = frame.faces.find(one => !hidden.has(one.layer) && inside(one.polygon, at.x, at.y));
    if (face) return { kind: 'face', key: face.key };
    const pair = frame.pairs.find(one => group && one.name && one.parts === group.dataset.pair);
    return pair && layer ? { kind: 'pair', key: pair.key } : null;
  }

  function mark(x, y) {
    for (const old of picture.querySelectorAll('.here')) old.remove();
    if (x === undefined) return;
    for (const name of ['here under', 'here']) {
      const ring = document.createElementNS('http://www.w3.org/2000/svg', 'circle');
      ring.setAttribute('class', name);
      ring.setAttribute('cx', x);
      ring.setAttribute('cy', y);
      ring.setAttribute('r', 13 * data.scale);
      picture.append(ring);
    }
  }

  function point_at(what, event) {
    const one = said(what);
    picture.classList.toggle('found', Boolean(one));
    for (const row of find('contacts').querySelectorAll('tbody tr'))
      row.classList.toggle('here', Boolean(one) && what.kind === 'point' && row.dataset.key === one.key);
    facts.hidden = !one;
    mark();
    if (!one) return;
    if (what.kind === 'point') mark(one.x, one.y);
    facts.replaceChildren();
    make('strong', one.name, facts);
    if (one.of) make('span', one.of, facts).className = 'of';
    const list = make('dl', undefined, facts);
    for (const [name, value] of one.rows) {
      make('dt', name, list);
      make('dd', value, list);
    }
    place_facts(one, event);
  }

  // Next to the point or the pointer, where the box covers the fewest points and sticks out of the view
  // least. In a narrow window the box is at the bottom.
  function place_facts(one, event) {
    const view = find('view').getBoundingClientRect(), matrix = picture.getScreenCTM();
    const on_screen = (x, y) => new DOMPoint(x, y).matrixTransform(matrix);
    let at = one.polygon && !event ? on_screen(...one.polygon[0]) : new DOMPoint(view.left, view.top);
    if (one.x !== undefined) at = on_screen(one.x, one.y);
    else if (event) at = new DOMPoint(event.clientX, event.clientY);
    const wide = facts.offsetWidth, high = facts.offsetHeight;
    const points = frames[shown].points.map(point => on_screen(point.x, point.y));
    let best = null;
    for (const [left, top] of [[20, -24], [20, 14], [20, 10 - high], [-20 - wide, -24], [-20 - wide, 14],
      [-20 - wide, 10 - high], [-wide / 2, 22], [-wide / 2, -22 - high]]) {
      const x = at.x - view.left + left, y = at.y - view.top + top;
      const beyond = Math.max(0, -x) + Math.max(0, -y) + Math.max(0, x + wide - view.width) +
          Math.max(0, y + high - view.height);
      const covered = points.filter(point => point.x > x + view.left - 6 && point.x < x + view.left + wide + 6 &&
          point.y > y + view.top - 6 && point.y < y + view.top + high + 6).length;
      const cost = 3 * beyond + 40 * covered;
      if (!best || cost < best.cost) best = { x, y, cost };
    }
    facts.style.left = Math.max(0, Math.min(best.x, view.width - wide)) + 'px';
    facts.style.top = Math.max(0, best.y) + 'px';
  }

  function hold(what, event) {
    held = what;
    facts.classList.toggle('held', Boolean(said(what)));
    point_at(what, event);
  }

  const same = (a, b) => a && b && a.kind === b.kind && a.key === b.key;
  picture.addEventListener('pointermove', event => {
    if (!held && event.pointerType !== 'touch') point_at(found_at(event), event);
  });
  picture.addEventListener('pointerleave', () => held || point_at(null));
  picture.addEventListener('click', event => {
    const what = found_at(event);
    hold(same(what, held) ? null : what, event);
  });

  // ---- The table of contacts

  function list_contacts(frame) {
    const points = frame.points.filter(point => point.row);
    const count = points.length;
    find('count').textContent = 'Contacts in this frame: ' + (count === 1 ? '1 point' : count + ' points');
    const head = find('contacts').querySelector('thead'), body = find('contacts').querySelector('tbody');
    head.replaceChildren();
    body.replaceChildren();
    if (count === 0 || !find('contacts').open) return;
    const names = [];
    for (const point of points)
      for (const [name] of point.rows)
        if (!names.includes(name)) names.push(name);
    const top = make('tr', undefined, head);
    for (const name of ['point', 'of', ...names]) make('th', name, top).scope = 'col';
    for (const point of points) {
      const row = make('tr', undefined, body);
      row.dataset.key = point.key;
      const what = { kind: 'point', key: point.key };
      const button = make('button', point.name, make('td', undefined, row));
      button.setAttribute('aria-label', point.name + ': show its facts in the picture');
      button.addEventListener('click', () => hold(same(what, held) ? null : what));
      make('td', point.of, row);
      for (const name of names) make('td', (point.rows.find(one => one[0] === name) || [])[1] || '', row);
      row.addEventListener('pointerenter', () => held || point_at(what));
      row.addEventListener('pointerleave', () => held || point_at(null));
    }
  }
  find('contacts').hidden = !data.points;
  find('contacts').addEventListener('toggle', () => list_contacts(frames[shown]));

  // ---- Buttons, slider, keys

  find('home').addEventListener('click', () => go(0));
  find('back').addEventListener('click', () => go(shown - 1));
  find('next').addEventListener('click', () => go(shown + 1));
  find('end').addEventListener('click', () => go(frames.length - 1));
  find('play').addEventListener('click', () => play(!timer));
  find('slider').addEventListener('input', () => go(Number(find('slider').value)));
  find('keys').addEventListener('click', () => find('help').showModal());

  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.altKey || event.metaKey || find('help').open) return;
    const on_button = /^(BUTTON|SUMMARY)$/.test(event.target.tagName) ||
        (event.target.tagName === 'INPUT' && event.target.type === 'checkbox');
    const step = event.shiftKey ? 10 : 1;
    const keys = {
      ArrowLeft: () => go(shown - step),
      ArrowRight: () => go(shown + step),
      Home: () => go(0),
      End: () => go(frames.length - 1),
      p: () => flip(panels),
      c: () => (find('contacts').open = !find('contacts').open),
      '?': () => find('help').showModal(),
      Escape: () => hold(null),
      0: () => layers.filter(box => !box.checked).forEach(flip),
    };
    if (!on_button) keys[' '] = () => play(!timer);
    for (let i = 0; i < Math.min(9, layers.length); ++i) keys[i + 1] = () => flip(layers[i]);
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  addEventListener('hashchange', () => linked() === null || show(linked()));
  addEventListener('resize', () => held && hold(held));
  if (frames.length === 1)
    for (const id of ['home', 'back', 'play', 'next', 'end', 'slider']) find(id).hidden = true;

  show(linked() ?? 0);
})();
