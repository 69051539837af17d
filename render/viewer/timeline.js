// Curves over the frames, one below the other, with the frame shown and marks of findings and search.

class Timeline {
  constructor(canvas, go) {
    this.canvas = canvas;
    this.rows = [['overlap', 'contacts', metres], ['points', 'text', digits], ['impulse', 'impulses', newtonSeconds]].filter(([name]) => Math.max(...data.totals[name]) > 0);
    const scrub = event => {
      const share = (event.clientX - canvas.getBoundingClientRect().left - 6) / (canvas.clientWidth - 12);
      go(Math.round(share * (data.frames.length - 1)));
    };
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      scrub(event);
    });
    canvas.addEventListener('pointermove', event => event.buttons && scrub(event));
  }
  x(frame) { return 6 + (this.canvas.clientWidth - 12) * frame / Math.max(1, data.frames.length - 1); }

  /** `found`: frames with what a search found; `css`: the colour of a role. */
  draw(frame, found, css) {
    const { canvas, rows } = this, [wide, high] = [canvas.clientWidth, canvas.clientHeight], top = 14, row = (high - top) / Math.max(1, rows.length);
    canvas.width = wide * devicePixelRatio;
    canvas.height = high * devicePixelRatio;
    const pen = canvas.getContext('2d');
    const rect = (role, alpha, ...box) => {
      Object.assign(pen, { fillStyle: css(role), globalAlpha: alpha });
      pen.fillRect(...box);
    };
    pen.scale(devicePixelRatio, devicePixelRatio);
    pen.font = '12px system-ui, sans-serif';
    rows.forEach(([name, role, words], i) => {
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
      const text = name + ' ' + words(values[frame]);
      rect('ground', 0.75, 8, floor - row + 6, pen.measureText(text).width + 6, 15);
      Object.assign(pen, { fillStyle: css('text'), globalAlpha: 1 });
      pen.fillText(text, 11, floor - row + 18);
    });
    for (const at of found) rect('finding', 1, this.x(at) - 0.75, 9, 1.5, 5);
    for (const at of new Set(data.findings.flatMap(finding => finding.places).filter(index => index >= 0))) {
      pen.beginPath();
      for (const [x, y] of [[-5, 0], [5, 0], [0, 9]]) pen.lineTo(this.x(at) + x, y);
      Object.assign(pen, { fillStyle: css('finding') }).fill();
    }
    rect('text', 1, this.x(frame) - 1, 0, 2, high);
  }
}
