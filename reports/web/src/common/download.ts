// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

/** Saves a file from the page. */
export function download(name: string, content: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export const saveText = (name: string, text: string, type: string): void => download(name, new Blob([text], { type }));

/** The picture of a canvas as PNG. */
export const pngOf = (canvas: HTMLCanvasElement): Promise<Blob> =>
  new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the picture cannot be written'))), 'image/png'),
  );

/** A cell of CSV: quoted where it must be. */
export const csvCell = (value: string | number): string => {
  const text = String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};
export const csvText = (rows: (string | number)[][]): string =>
  `${rows.map((row) => row.map(csvCell).join(',')).join('\n')}\n`;
