// Numbers as a person would write them, and round ones for axes.

// Three digits; a true minus sign, and a power of ten where the number is very small or large.
export function formatNumber(value) {
  if (!Number.isFinite(value)) return "–";
  value = Number(value.toPrecision(3));
  const size = Math.abs(value);
  if (size !== 0 && (size < 0.001 || size >= 1e5)) {
    const exponent = Math.floor(Math.log10(size));
    return `${formatNumber(value / 10 ** exponent)}·${powerOfTen(10 ** exponent)}`;
  }
  const digits = Math.max(0, Math.min(4, 2 - Math.floor(Math.log10(size || 1))));
  return value.toFixed(digits).replace("-", "−");
}

// So many of a thing.
export function counted(count, thing) {
  return `${count} ${thing}${count === 1 ? "" : "s"}`;
}

// A power of ten with its exponent raised.
export function powerOfTen(value) {
  const exponent = Math.round(Math.log10(value));
  const raised = String(Math.abs(exponent)).replace(/./g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]);
  return exponent === 0 ? "1" : exponent === 1 ? "10" : `10${exponent < 0 ? "⁻" : ""}${raised}`;
}

// A round number in the few characters that there is room for beside an axis.
export function formatTick(value) {
  const power = 10 ** Math.floor(Math.log10(Math.abs(value) || 1));
  const written = power < 1e5 ? String(value) : `${Number((value / power).toPrecision(3))}·${powerOfTen(power)}`;
  return written.replace("-", "−");
}

// Round numbers between two ends, some `wanted` of them, and the step between them.
export function roundSteps(lowest, highest, wanted) {
  const rough = (highest - lowest) / wanted || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const first = Math.ceil(lowest / step - 1e-9);
  const count = Math.max(0, Math.floor(highest / step + 1e-9) - first + 1);
  return { step, values: Array.from({ length: count }, (_, k) => Number(((first + k) * step).toPrecision(12))) };
}

// The powers of ten between two ends.
export function decades(lowest, highest) {
  const first = Math.ceil(Math.log10(lowest) - 1e-9);
  const count = Math.max(0, Math.floor(Math.log10(highest) + 1e-9) - first + 1);
  return Array.from({ length: count }, (_, k) => 10 ** (first + k));
}
