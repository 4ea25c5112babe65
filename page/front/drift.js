// Drifts over time, on a logarithmic scale.
const [LEAST, MOST] = [-17, 0];

function drawDrift(canvas, history, which, unit) {
  const [context, width, height] = clear(canvas);
  if (!width) return;
  const [left, right, top, bottom] = [46, 6, 10, 22];
  const [w, h] = [width - left - right, height - top - bottom];
  const rows = history.length / 7;
  const end = rows ? history[7 * (rows - 1)] : 0;
  const long = Math.abs(end) || 1;
  const x = (t) => left + (Math.abs(t) / long) * w;
  const y = (drift) => {
    const power = drift > 0 ? Math.log10(drift) : LEAST;
    return top + (1 - (Math.min(Math.max(power, LEAST), MOST) - LEAST) / (MOST - LEAST)) * h;
  };
  context.font = FONT.replace("14px", "13px");
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const [power, text] of [[0, "1"], [-8, "10⁻⁸"], [-16, "10⁻¹⁶"]]) {
    const at = Math.round(y(10 ** power)) + 0.5;
    line(context, [[left, at], [width - right, at]], colours.line, 1);
    context.fillStyle = colours.soft;
    context.fillText(text, left - 8, at);
  }
  context.textBaseline = "alphabetic";
  context.fillText("0", left + 4, height - 4);
  if (end) context.fillText(`${shortly(end)}${unit ? " " + unit : ""}`, width - right, height - 4);
  context.save();
  context.beginPath();
  context.rect(left, 0, w + right, height);
  context.clip();
  for (const [offset, colour, dash] of [[4, colours.rival, [6, 4]], [1, colours.ours, []]]) {
    const places = [];
    for (let i = 0; i < rows; i++) {
      const drift = history[7 * i + offset + which];
      if (Number.isNaN(drift)) break;
      // The start, where nothing has drifted, is left out.
      if (i > 0 || rows === 1) places.push([x(history[7 * i]), y(drift)]);
    }
    context.lineJoin = "round";
    line(context, places, colour, 2, dash);
  }
  context.restore();
}
