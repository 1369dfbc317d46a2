// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The overview, top to bottom. A section is one file and one line here, where it shall stand; one with a title stands in
// the page's navigation.
import { benchSection } from '../bench/section.ts';
import { run } from '../run.ts';
import { studySection } from '../study/page.ts';
import { contactQueries, contactsActedUpon } from './contacts.ts';
import { engines } from './engines.ts';
import { headline } from './headline.ts';
import { insertionOrders } from './insertion_orders.ts';
import { ledgerSummary } from './ledger.ts';
import { method } from './method.ts';
import { scoreboard } from './scoreboard.ts';
import { timing } from './timing.ts';
import { trust } from './trust.ts';

interface OverviewSection {
  id: string; // id of its element
  title: string; // title in the navigation; "": not there
  make: () => HTMLElement | null;
}

/** A run of `rigor bench` has no cases to judge: the parts about them are left out. */
const judged = (make: () => HTMLElement | null) => () => (run.columns.length > 0 ? make() : null);

const sections: OverviewSection[] = [
  { id: 'summary', title: '', make: judged(headline) },
  { id: 'study', title: 'Study', make: studySection },
  { id: 'bench', title: 'Bench', make: benchSection },
  { id: 'trust', title: 'Which engine', make: judged(trust) },
  { id: 'scoreboard', title: 'Scoreboard', make: judged(scoreboard) },
  { id: 'insertion-orders', title: 'Insertion order', make: insertionOrders },
  { id: 'timing', title: 'Cost', make: timing },
  { id: 'in-run', title: 'Contacts', make: contactsActedUpon },
  { id: 'audit', title: 'Contact queries', make: contactQueries },
  { id: 'ledger', title: 'Parity ledger', make: judged(ledgerSummary) },
  { id: 'engines', title: 'Engines', make: engines },
  { id: 'method', title: 'Method', make: judged(method) },
];

export const overview: (() => HTMLElement | null)[] = sections.map((s) => s.make);

/** Sections that this run has something for. */
export function navigation(): { id: string; title: string }[] {
  const has: Record<string, boolean> = {
    bench: Boolean(run.bench),
    scoreboard: run.columns.length > 0,
    ledger: run.columns.length > 0,
    method: run.columns.length > 0,
    study: document.getElementById('study-data') !== null,
    trust: run.columns.length > 0 && run.mechanisms.length > 0,
    'insertion-orders': Boolean(run.insertionOrders),
    timing: run.scenarios.some((s) => s.cases.some((c) => c.step)),
    'in-run': run.scenarios.some((s) => s.cases.some((c) => c.inRun?.overlapping)),
    audit: run.audit.length > 0,
  };
  return sections.filter((s) => s.title && has[s.id] !== false);
}
