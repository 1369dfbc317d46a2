// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library, and small helpers: numbers as attributes of XML, elements, and results of six numbers.
import load from '@mujoco/mujoco';
import * as rg from '../../sdk/rigor_guest.mjs';

export const M = await load();

const six = new M.DoubleBuffer(6);

/** Runs `use` with a buffer of six numbers and returns them. */
export function sixNumbers(use) {
    use(six);
    return [...six.GetView()];
}

const text = (value) => (Array.isArray(value) ? value.map(text).join(' ') : String(value));
const escaped = (value) => text(value).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** An XML element; attributes that are undefined are left out. */
export function element(name, attributes, children = []) {
    const listed = Object.entries(attributes).filter(([, value]) => value !== undefined);
    const written = listed.map(([key, value]) => ` ${key}="${escaped(value)}"`).join('');
    return children.length === 0 ? `<${name}${written}/>` : `<${name}${written}>${children.join('')}</${name}>`;
}

/** The model of a text; `files`: those that it names, an MjVFS. */
export function modelOf(xml, files) {
    try {
        return files ? M.MjModel.from_xml_string(xml, files) : M.MjModel.from_xml_string(xml);
    } catch (error) {
        throw new rg.BadInput(String(error.message ?? error).trim());
    }
}

/** A matrix of 9 numbers, row by row, of a unit quaternion, and back. */
export const columnsOf = (q) => [rg.rotate(q, [1, 0, 0]), rg.rotate(q, [0, 1, 0]), rg.rotate(q, [0, 0, 1])];
