// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page's data as reports/page/page_data.cpp, audit_json.cpp, refinements.cpp and study_charts.cpp write them. SI units; dt and
// all costs in seconds. A field that only newer runs have is marked with `?` or may be null.
import type { ContactFinding } from '../common/finding.ts';
import type { Maybe, Stored } from '../common/format.ts';

/** A verdict as shown; the order in the page's `symbols` is from the best to the worst. */
export type Shown =
  | 'pass'
  | 'no_bound'
  | 'no_reference'
  | 'known_deviation'
  | 'fail'
  | 'non_finite'
  | 'timeout'
  | 'crashed'
  | 'unsupported';

/** One engine as it took part: a column of the scoreboard. */
export interface Column {
  spec: string;
  engine: string;
  preset: string;
  options: string; // options of the spec, without the preset
  label: string;
  clock?: string; // "guest, wasm" where its times are not those of modules; only those of equal ones are compared
  dash: number[]; // dash pattern of its lines; empty: solid
}

/** A list of names, or one fact, that an engine reports of itself. */
export type Capability = string | number | boolean | null | Capability[] | { [key: string]: Capability };

/** A setting of an engine spec. */
export interface EngineOption {
  key: string;
  values: string[]; // empty: a number
  min: Maybe;
  max: Maybe;
  presets: Record<string, string>; // value in each preset
  help: string;
}

export interface Described {
  capabilities: { [key: string]: Capability };
  presets: string[]; // presets that it has
  options: EngineOption[];
}

export interface Engine {
  name: string;
  title: string;
  version: string;
  precision: string;
  buildNotes: string;
  problem: string; // reason why it could not take part; "" when it did
  described?: Described | null; // declared features; null in runs that did not store it
}

export interface Step {
  median: Stored;
  low?: Maybe; // 95 % interval of the median
  high?: Maybe;
  p10: Stored;
  p90: Stored;
  samples: number;
  contacts: Stored; // mean number of contacts
  bodies?: number; // number of moving bodies; 0: not stored
  phases?: Record<string, Stored>; // medians
  first?: Maybe; // the first step; the following are of all others
  mean?: Maybe;
  p95?: Maybe;
  p99?: Maybe;
  worst?: Maybe;
  realTimeFactor?: Maybe; // dt over the mean
}

/**
 * Costs of a column: medians over the scenarios at their finest time steps; the mean and the statistics after it
 * without the first step.
 */
export interface StepCost {
  scenarios: number;
  median: Stored;
  mean: Stored;
  first: Stored;
  p95: Stored;
  p99: Stored;
  worst: Stored;
  realTimeFactor: Stored;
  medianRatio: Stored; // geometric means over the cheapest
  meanRatio: Stored;
}

/** Contacts that a run acted upon, against the exact oracle. */
/** Place of a wrong normal. */
export interface WrongNormal {
  what: 'normal' | 'point_normal'; // point of the contact: the deepest one, or any
  error: Maybe; // [rad]
  pair: string; // "block|floor"
  time: number; // [s]
  step: number; // steps up to the frame
  contact: number; // index among the contacts of the frame
  distance: Maybe; // exact signed distance of the shapes [m]
}

export interface InRun {
  queries: number;
  overlapping: number;
  missed: number;
  spurious: number;
  normal: Maybe; // [rad]
  depth: Maybe; // [m]
  point: Maybe; // [m]
  worst: string;
  normals?: WrongNormal[]; // the worst of each kind; none in stores without findings
  normalFlicker: Maybe;
  contactFlicker: Maybe;
}

export interface Miss {
  name: string;
  subject: string;
  unit: string;
  value: Stored;
  bound: Stored;
  boundMin?: Maybe; // lower bound; null: none
  at: Stored; // [s]; < 0 unknown
}

export type Regression = 'unchanged' | 'better' | 'worse' | 'no record';

/**
 * Grade of a case and its change against the record: counted and worded by reports/model/rankings.cpp, sentences.cpp.
 */
export interface Judged {
  grade: string; // "A" .. "E"; "": not graded
  by: string; // the metric that decides
  of?: string; // quantity, body or joint that it is largest for; "" the whole scene
  relative: Maybe; // its error over the scenario's own scale
  ideal: Maybe; // the same of an ideal run of the engine's scheme; null: not known
  beside: 'unknown' | 'nearer' | 'same' | 'farther'; // relation to that ideal run
  toBest: Maybe; // relative error over the smallest at this time step
  toOurs: Maybe; // ratio to the in-house engine's
  regression: Regression;
  red: boolean;
  says: string; // sentence on accuracy
  change: string; // sentence on the record; may be ""
  orders?: Orders | null; // orders of insertion; null: run in one order
}

/** A case that was run in several orders of insertion. */
export interface Orders {
  run: number;
  completed: number;
  best: string; // grades; "" where the case is not graded
  worst: string;
  depends: 'no' | 'value' | 'grade' | 'verdict'; // the gravest thing that depends on the order
  mark: string; // '⇅' for a verdict, '↕' for a grade or a value, ''
  says: string; // a sentence
}

/** A case that depends on the order of insertion. */
export interface OrderDependent {
  scenario: string;
  spec: string;
  dt: number;
  metric: string; // metric that varies most, with its unit and values; "" where endings alone differ
  unit: string;
  value: Maybe; // value in the order as written
  least: Maybe;
  greatest: Maybe;
  run: number; // orders
  completed: number;
  dependence: 'value' | 'grade' | 'verdict'; // the gravest thing that depends on the order
  verdicts: string; // "2 of 5 orders fail (pass 3, fail 2)"; '' where all have one
  grade: string; // grade in the order as written
  best: string; // grades over the orders
  worst: string;
  note: string;
}

/** A case as the overview knows it. */
export interface BriefCase {
  id: string;
  spec: string;
  dt: number;
  outcome: string;
  verdict: string;
  shown: Shown;
  reason: string;
  refusal?: string; // refusal of an unsupported case: adapter or library
  value: Maybe; // value of the scenario's main metric
  subject?: string; // quantity, body or joint that it is largest for
  bound: Maybe;
  range?: string | null; // range of that metric over orders of insertion, if it is wider than rounding
  step: Step | null;
  inRun: InRun | null;
  miss?: Miss | null; // the metric furthest outside its bound
  judged: Judged;
}

export interface MainMetric {
  name: string;
  unit: string;
  kind: string;
}

export interface Scenario {
  name: string;
  title: string;
  description: string;
  source: string;
  isolates: string[];
  tags: string[];
  observed: string[];
  metrics: string[];
  dimension: number;
  duration: number;
  timeSteps: number[];
  reference: string;
  referenceTitle: string;
  referenceFormula: string;
  referenceTex?: string;
  referenceSource: string;
  referenceProblem: string;
  main: MainMetric;
  cases: BriefCase[];
}

/** Results of a column over some scenarios, each at its finest time step. */
export interface Ranking {
  scenarios: number; // it could take part in
  lost: number; // crashed, timed out, not finite, or not as requested
  grades: number[]; // scenarios of grade A to E
  within: number; // scenarios of grade C or better
  ungraded: number;
  known: number; // wrong physics with a reason on file
  farther: number; // scenarios farther from the solution than its own scheme
  red: number;
  toBest: Maybe; // typical error over the best engine's
  toOurs: Maybe; // ratio to the in-house engine's
  cost: Maybe; // median of a step in the scenarios that can be graded, in all where none can [s]
  timed: number; // scenarios of `cost`
  costRatio: Maybe; // ratio to the cheapest engine's
}

/** Scenarios of one mechanism, or of one thing that people simulate. */
export interface Mechanism {
  name: string; // name; for a task its key
  title: string; // title of a task
  about: string;
  scenarios: string[];
  order: number[]; // columns that took part, the most trusted first
  engines: number[]; // columns of `order`, of each engine its first one: its best preset
  best: number; // column; -1: none
  rankings: Ranking[]; // one ranking per column
}

export interface Audit {
  auditor: string; // engine, "oracle", "in_run" or "a|b"
  outcome: string;
  frames: number;
  queries: number;
  overlapping: number;
  missed: number;
  spurious: number;
  undecided: number;
  normalErrorMax: Maybe; // [rad]
  normalErrorMedian: Maybe;
  depthErrorMax: Maybe; // [m]
  depthErrorMedian: Maybe;
  pointErrorMax: Maybe;
  worst: string; // "block|floor at t=0.25"
  note: string;
  findings?: ContactFinding[]; // the worst of each kind; of one case alone
}

export interface LedgerLine {
  topic: string;
  requested: string;
  resolved: string;
  realisation: string; // exact, approximate, unsupported
  reason: string;
}

export interface GatheredLedger extends LedgerLine {
  engine: string;
  preset: string;
  scenarios: string[];
}

/** Lists over all scenarios. */
export interface RunLists {
  audit: { scenario: string; rows: Audit[] }[];
  ledger: GatheredLedger[];
}

/** Content of run-data: the overview. */
export interface Run extends RunLists {
  single?: string; // a page of this scenario alone, in one file
  suite: string;
  title: string; // the suite, or the first of the scenarios named
  command: string;
  started: string;
  finished: string;
  planned: number;
  total: number;
  environment: Record<string, string>;
  bench?: Bench | null; // results of `rigor bench`
  symbols: Record<Shown, { symbol: string; word: string; count: number; detail: string }>;
  columns: Column[];
  engines: Engine[];
  scenarios: Scenario[];
  caseFiles?: number[] | null; // a large run: the first scenario of each data/cases-<n>.js, which have the cases;
  // the lists of RunLists are empty here then, and in data/lists.js
  redCases: { scenario: string; spec: string; dt: number }[]; // the first ones
  timed: boolean; // some case has times
  touching: boolean; // some case had contacts that were audited
  grades: { name: string; meaning: string; count: number }[]; // A to E, then ""
  regressions: Record<Regression, number>;
  red: number;
  inHouse: string; // engine of the authors
  likeForLike: string; // preset in which engines are as near to each other as they come
  mechanisms: Mechanism[];
  tasks: Mechanism[];
  overall: Mechanism;
  costs?: StepCost[]; // costs by column
  insertionOrders?: { heading: string; rows: OrderDependent[] } | null; // null: every case in one order
  audited: boolean; // the audit has rows
}

/** Timing of `rigor bench` as reports/tables/bench.cpp writes it. Times in seconds an operation. */
export interface BenchCase {
  id: string;
  part: string; // 'scene', or an isolated part
  name: string;
  engine: string; // spec
  label: string; // short name of the spec
  size: Stored;
  sizeUnit: string; // '' where there is no size
  threads: number;
  operation: string;
  command: string;
  repetitions: number;
  clock: string; // clock of time, low, high and the ratio: 'cpu' or 'wall'
  time: Maybe; // median
  low: Maybe;
  high: Maybe;
  wall: Stored;
  cpu: Stored;
  converged: boolean;
  valid: boolean;
  reason: string; // reason why not
  base: string; // id
  ratio: Maybe;
  ratioLow: Maybe;
  ratioHigh: Maybe;
  memoryKiB: Maybe;
  peakKiB: Maybe;
  allocations: Maybe; // an operation
  counts: Record<string, Stored>;
  phases: Record<string, Stored>;
  quality: { name: string; unit: string; value: Stored; min: Maybe; max: Maybe; ok: boolean }[];
}
export interface BenchChange {
  id: string;
  before: Stored;
  after: Stored;
  ratio: Stored;
  low: Stored;
  high: Stored;
  p: Stored;
  verdict: string;
  reason: string;
}
export interface Bench {
  settings: Record<string, string>;
  cases: BenchCase[];
  changes: BenchChange[];
}

export interface Metric {
  name: string;
  subject: string; // "" the whole scene
  unit: string;
  kind: string;
  value: Stored;
  at: Maybe; // [s] of the largest contribution; < 0 unknown
  bound: Maybe;
  boundMin?: Maybe; // lower bound; null: none
  expectation: Maybe;
  verdict: string;
  note: string;
  scale: Maybe; // scale of the value, in its unit
  relative: Maybe;
  ideal: Maybe;
  recorded: Maybe;
  orderMin?: Maybe; // least value over orders of insertion
  orderMax?: Maybe;
  orderCount?: number | null;
  dependsOnOrder?: boolean; // the range is wider than rounding
  grade: string;
}

export interface Quantity {
  name: string;
  unit: string;
  exact: Stored;
  schemeExact: Maybe;
  measured: Maybe;
}

export interface ReadBack {
  compared: number;
  bad: number;
  differing: { quantity: string; subject: string; expected: Stored; found: Stored; error: Stored }[];
}

export interface Timing {
  phase: string;
  median: Stored;
  low?: Maybe;
  high?: Maybe;
  p10: Stored;
  p90: Stored;
  total: Stored;
  samples: number;
  meanContacts: Stored;
  bodies?: number;
  first?: Maybe; // the first sample; the following are of all others
  mean?: Maybe;
  p95?: Maybe;
  p99?: Maybe;
  worst?: Maybe;
  realTimeFactor?: Maybe; // dt over the mean of a step
}

export interface BodyCurve {
  name: string;
  position: (string | null)[]; // packed singles
}

export interface Curves {
  samples: number;
  t: string; // packed singles
  bodies: BodyCurve[];
  reference?: BodyCurve[];
  series: { name: string; subject: string; unit: string; t?: string; y: string }[];
}

/** A case with everything that is stored of it. */
export interface Case {
  id: string;
  spec: string;
  dt: number;
  outcome: string;
  verdict: string;
  shown: Shown;
  reason: string;
  wallSeconds: Stored;
  cpuSeconds: Stored;
  steps: number;
  peakMemoryKiB: number;
  stateHash: string;
  trajectoryFile: string;
  command: string;
  settings: Record<string, string>;
  metrics: Metric[];
  quantities: Quantity[];
  ledger: LedgerLine[];
  readBack: ReadBack;
  audit: Audit[];
  timings: Timing[];
  curves: Curves | null;
  judged: Judged;
}

export interface Order {
  spec: string;
  metric: string;
  unit: string;
  order: Maybe;
  low: Maybe;
  high: Maybe;
  points: number;
  finest: Stored;
  coarsest: Stored;
  note: string;
}

export interface Fairness {
  mode: string;
  metric: string;
  unit: string;
  competitor: string;
  spec: string;
  dt: Stored;
  error: Stored;
  cost: Stored;
  limit: Maybe;
}

/** Content of data/cases-<n>.js: the cases of each of its scenarios. */
export type CaseFile = BriefCase[][];

/** Content of data/scenario-<n>.js. */
export interface ScenarioData {
  name: string;
  text: string; // the scenario file as run
  start?: { position: string; orientation: string } | null; // packed singles of all bodies at the start
  files?: string[]; // files of tables and plots beside the page
  cases: Case[];
  orders: Order[];
  fairness: Fairness[];
}

export interface StudyPoint {
  label: string;
  x: Maybe;
  value: Maybe;
  low: Maybe;
  high: Maybe;
  note: string;
  outcome: string;
}

export interface StudyChart {
  part: string;
  scenario: string;
  metric: string;
  unit: string;
  axis: string; // empty: a bar for each point
  logarithmic: boolean;
  logarithmicX: boolean;
  points: StudyPoint[];
}

export interface StudyRow {
  variant: string;
  spec: string;
  scenario: string;
  base: string;
  dt: number;
  parameters: Record<string, unknown>;
  ran: boolean;
  outcome: string;
  metrics: Record<string, { value: Maybe; unit: string; low?: Maybe; high?: Maybe; note?: string }>;
}

export interface Finding {
  statement: string;
  source: string;
  variant: string;
  metric: string;
  where: Record<string, unknown>;
  at_least: Maybe;
  at_most: Maybe;
  least: Maybe;
  greatest: Maybe;
  holds: boolean;
}

export interface Symptom {
  name: string;
  metric: string;
  growth: unknown;
  fault: string;
  fault_value: Maybe;
  cure: string;
  cure_value: Maybe;
  switched: string[];
  shown: boolean;
  cured: boolean;
}

/** Content of study-data. */
export interface Study {
  name: string;
  title: string;
  description: string;
  findings: Finding[];
  symptoms: Symptom[];
  parts: { name: string; title: string; description: string; rows: StudyRow[] }[];
  charts: StudyChart[];
}
