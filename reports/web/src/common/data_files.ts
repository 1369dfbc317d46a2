// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data beside the page: `data/<name>.js` is a script that calls rigorData(name, base64 of gzip), because a page
// opened from disk may run scripts beside it but not fetch files. reports/encoding/data_files.cpp writes them.

const waiting = new Map<string, { resolve: (text: string) => void; reject: (error: Error) => void }>();
const cache = new Map<string, Promise<ArrayBuffer>>();

declare global {
  var rigorData: ((name: string, base64: string) => void) | undefined;
}

globalThis.rigorData = (name, base64) => {
  waiting.get(name)?.resolve(base64);
  waiting.delete(name);
};

/** The content of a data file, fetched once. Rejects when there is none, or when it is damaged. */
export function loadData(name: string): Promise<ArrayBuffer> {
  let found = cache.get(name);
  if (found === undefined) {
    found = fetchScript(name).then(inflate);
    cache.set(name, found);
    found.catch(() => cache.delete(name));
  }
  return found;
}

export async function loadJson<T>(name: string): Promise<T> {
  return JSON.parse(new TextDecoder().decode(await loadData(name))) as T;
}

/** The same of a file that the caller keeps the content of. */
export async function loadJsonOnce<T>(name: string): Promise<T> {
  return JSON.parse(new TextDecoder().decode(await inflate(await fetchScript(name)))) as T;
}

/** The content of a data file as it is written: base64 of gzip. */
export const loadText = (name: string): Promise<string> => fetchScript(name);

/** Data that stands in the page itself: a page of one file has nothing beside it. */
function embedded(name: string): string | null {
  const text = document.getElementById(`data-${name}`)?.textContent;
  return text ? (JSON.parse(text) as string) : null;
}

function fetchScript(name: string): Promise<string> {
  const own = embedded(name);
  if (own !== null) return Promise.resolve(own);
  return new Promise((resolve, reject) => {
    waiting.set(name, { resolve, reject });
    const script = document.createElement('script');
    script.src = `data/${name}.js`;
    const fail = () => {
      waiting.delete(name);
      reject(new Error(`data/${name}.js is missing or damaged: keep the folder of the report together`));
    };
    script.onerror = fail;
    script.onload = () => {
      script.remove();
      if (waiting.has(name)) fail();
    };
    document.head.append(script);
  });
}

export async function inflate(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}
