// Curves over the frames, one below the other, with the frame shown and marks of findings and search.

class Timeline {
  /** `place`: an element with a canvas. `css`: the colour of a role. */
  constructor(place, go, css) {
    const canvas = place.querySelector('canvas');
    Object.assign(this, { canvas, css, found: null, finding: null, drawn: '' });
    this.rows = [['overlap', 'contacts', metres], ['points', 'text', digits], ['impulse', 'impulses', newtonSeconds]].filter(([name]) => Math.max(...data.totals[name]) > 0);
    this.texts = this.rows.map(() => make('span', '', place));
    this.now = make('i', undefined, place);
    const scrub = event => {
      const share = (event.clientX - canvas.getBoundingClientRect().left - 6) / (canvas.clientWidth - 12);
      go(Math.round(share * (data.frames.length - 1)));
    };
    place.addEventListener('pointerdown', event => {
      place.setPointerCapture(event.pointerId);
      scrub(event);
    });
    place.addEventListener('pointermove', event => event.buttons && scrub(event));
  }
  x(frame) { return 6 + (this.canvas.clientWidth - 12) * frame / Math.max(1, data.frames.length - 1); }

  /** `found`: frames with what a search found. `finding`: the open one, whose marks stand out. */
  draw(frame, found, finding) {
    const { canvas, rows, css } = this, [wide, high] = [canvas.clientWidth, canvas.clientHeight], top = 14, row = (high - top) / Math.max(1, rows.length);
    this.now.style.transform = 'translateX(' + (this.x(frame) - 1) + 'px)';
    rows.forEach(([name, , words], i) => {
      this.texts[i].textContent = name + ' ' + words(data.totals[name][frame]);
      this.texts[i].style.top = top + i * row + 3 + 'px';
    });
    // The curves stay as they are while frames change: without a GPU they would take a third of the time.
    const now = [wide, high, devicePixelRatio, css('ground')].join();
    if (this.found === found && this.finding === finding && this.drawn === now) return;
    Object.assign(this, { found, finding, drawn: now });
    canvas.width = wide * devicePixelRatio;
    canvas.height = high * devicePixelRatio;
    const pen = canvas.getContext('2d');
    pen.scale(devicePixelRatio, devicePixelRatio);
    rows.forEach(([name, role], i) => {
      const values = data.totals[name], most = Math.max(...values), floor = top + (i + 1) * row - 3;
      pen.beginPath();
      pen.moveTo(this.x(0), floor);
      // The largest value of each pixel, so that no peak is lost.
      const step = Math.max(1, Math.floor(values.length / wide));
      for (let at = 0; at < values.length; at += step) pen.lineTo(this.x(at), floor - (row - 7) * Math.max(...values.subarray(at, at + step)) / most);
      pen.lineTo(this.x(data.frames.length - 1), floor);
      Object.assign(pen, { fillStyle: css(role), strokeStyle: css(role), globalAlpha: 0.18, lineWidth: 1.25 });
      pen.fill();
      pen.globalAlpha = 1;
      pen.stroke();
    });
    pen.fillStyle = css('finding');
    for (const at of found) pen.fillRect(this.x(at) - 0.75, 9, 1.5, 5);
    const mark = (findings, wide, high) => {
      for (const at of new Set(findings.flatMap(one => one.places).filter(index => index >= 0))) {
        pen.beginPath();
        for (const [x, y] of [[-wide, 0], [wide, 0], [0, high]]) pen.lineTo(this.x(at) + x, y);
        pen.fill();
      }
    };
    if (finding) {
      pen.globalAlpha = 0.3;
      mark(data.findings, 3, 4);
      pen.globalAlpha = 1;
    }
    mark(finding ? [finding] : data.findings, 5, 9);
  }
}
