// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The overview: tabs of sections. A section is one file and one line here, where it shall stand. The address of a tab, and
// of a section in it, is "#id".
import { benchSection } from '../bench/section.ts';
import { termPrefix } from '../glossary_terms.ts';
import { run, study } from '../run.ts';
import { studySection } from '../study/page.ts';
import { contactQueries, contactsActedUpon } from './contacts.ts';
import { engines } from './engines.ts';
import { glossary } from './glossary.ts';
import { headline } from './headline.ts';
import { insertionOrders } from './insertion_orders.ts';
import { ledgerSummary } from './ledger.ts';
import { method } from './method.ts';
import { scoreboard } from './scoreboard.ts';
import { timing } from './timing.ts';
import { trust } from './trust.ts';

interface OverviewSection {
  id: string; // id of its element
  make: () => HTMLElement | null;
  has?: () => boolean; // false: this run has nothing for it
  cases?: boolean; // it needs the cases, which in a large run stand beside the page,
  lists?: boolean; // it needs the audit and the parity ledger, which stand there too
}

export interface Tab {
  id: string;
  title: string;
  sections: OverviewSection[];
}

/** A run of `rigor bench` has no cases to judge: the parts about them are left out. */
const hasCases = () => run.columns.length > 0;
const hasBench = () => Boolean(run.bench);
const hasSteps = () => run.timed;
const hasOverlaps = () => run.touching;

/** The purpose of a run comes first: a study, a bench, or the verdict. */
const all: Tab[] = [
  {
    id: 'study',
    title: 'Study',
    sections: [
      { id: 'summary', make: headline, has: () => study !== null && hasCases() },
      { id: 'study', make: studySection, has: () => study !== null },
    ],
  },
  {
    id: 'bench',
    title: 'Bench',
    sections: [
      { id: 'bench', make: benchSection, has: hasBench },
      { id: 'engines', make: engines, has: () => hasBench() && !hasCases() },
    ],
  },
  {
    id: 'verdict',
    title: 'Verdict',
    sections: [
      { id: 'summary', make: headline, has: hasCases },
      { id: 'trust', make: trust, has: hasCases, cases: true },
      { id: 'insertion-orders', make: insertionOrders, has: () => Boolean(run.insertionOrders) },
    ],
  },
  {
    id: 'scoreboard',
    title: 'Scoreboard',
    sections: [{ id: 'scoreboard', make: scoreboard, has: hasCases, cases: true }],
  },
  { id: 'cost', title: 'Cost', sections: [{ id: 'timing', make: timing, has: hasSteps, cases: true }] },
  {
    id: 'contacts',
    title: 'Contacts',
    sections: [
      { id: 'in-run', make: contactsActedUpon, has: hasOverlaps, cases: true },
      { id: 'audit', make: contactQueries, has: () => run.audited, cases: true, lists: true },
    ],
  },
  {
    id: 'ledger',
    title: 'Parity ledger',
    sections: [{ id: 'ledger', make: ledgerSummary, has: hasCases, lists: true }],
  },
  {
    id: 'method',
    title: 'Method',
    sections: [
      { id: 'method', make: method, has: hasCases },
      { id: 'engines', make: engines, has: hasCases },
    ],
  },
  { id: 'glossary', title: 'Glossary', sections: [{ id: 'glossary', make: glossary, has: hasCases }] },
];

/** Tabs that this run has something for, with their sections. */
export const tabs: Tab[] = (run.single ? all.filter((tab) => tab.id === 'method' || tab.id === 'glossary') : all)
  .map((tab) => ({ ...tab, sections: tab.sections.filter((s) => s.has?.() !== false) }))
  .filter((tab) => tab.sections.length > 0);

/** The tab of an address "#id", which may be that of a section or of a term; the first one for any other. */
export function tabOf(id: string): Tab {
  const place = id.startsWith(termPrefix) ? 'glossary' : id;
  return tabs.find((tab) => tab.id === place || tab.sections.some((s) => s.id === place)) ?? (tabs[0] as Tab);
}
