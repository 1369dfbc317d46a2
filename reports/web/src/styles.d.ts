// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
// Style sheets are gathered by the bundler.
declare module '*.css';
declare module '*.def' {
  const text: string;
  export default text;
}
