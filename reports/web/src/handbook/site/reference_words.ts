// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Titles, headings and introductions of the reference and the gallery in each language. What comes from the program's
// tables and from documents beside the code is English.
import type { Language } from './contents.ts';
import { chineseKinds, chineseUnits } from './metric_titles.ts';

interface ReferenceWords {
  commandLine: string;
  specs: string;
  specsText: string;
  specColumns: [string, string, string, string];
  facts: (version: string, precisions: string, presets: string) => string;
  algorithms: string;
  algorithmsText: string;
  isDefault: string;
  scenarios: string;
  sceneFacts: (dimension: number, bodies: number, duration: number) => string[];
  reference: string;
  studiesPage: string;
  suites: string;
  suitesText: string;
  suiteSize: (count: number) => string;
  studies: string;
  studiesText: string;
  metrics: string;
  metricsText: string;
  metricFacts: (kind: string, unit: string) => string;
  references: string;
  referencesText: string;
  source: string;
  from: (file: string) => string;
  schemas: string;
  schemasText: string;
  lines: (count: number) => string;
  api: string;
  apiText: string;
  gallery: string;
  galleryText: (version: string) => string;
  report: string;
  noReport: string;
  command: string;
  part: string; // title of this part in the table of contents
  comma: string; // between words of a list
  colon: string;
}

export const referenceWords: Record<Language, ReferenceWords> = {
  en: {
    commandLine: 'Command line and exit codes',
    specs: 'Engines and their settings',
    specsText:
      'An engine is named by a spec, <code>NAME:key=value,key=value</code>. These engines were installed where this page was made; <code>./rigor list engines</code> shows yours.',
    specColumns: ['key', 'default value', 'if matched', 'meaning and values'],
    facts: (version, precisions, presets) => `version ${version}; precision ${precisions}; presets ${presets}`,
    algorithms: 'Algorithms of the engine',
    algorithmsText:
      'What the in-house engine can do at every stage of its step. A choice is made in a spec, as in rigor:solver=nsgs,substeps=4.',
    isDefault: '(default)',
    scenarios: 'Scenarios of the library',
    sceneFacts: (dimension, bodies, duration) => [`${dimension}D`, `${bodies} bodies`, `${duration} s`],
    reference: 'reference',
    studiesPage: 'Suites and studies',
    suites: 'Suites',
    suitesText: 'Lists of scenarios for rigor validate.',
    suiteSize: (count) => `${count} scenarios`,
    studies: 'Studies',
    studiesText: 'Grids of choices for rigor study; beside each the parts that --part selects.',
    metrics: 'Metrics',
    metricsText: 'Every metric is one pure function from a trajectory to a number, the same for every engine.',
    metricFacts: (kind, unit) => `${kind}, unit ${unit}`,
    references: 'References',
    referencesText: 'Exact solutions that scenarios name under "reference", with their sources.',
    source: 'Source: ',
    from: (file) => `From <code>${file}</code>.`,
    schemas: 'JSON schemas',
    schemasText: 'What rigor check holds files to before it looks at their meaning.',
    lines: (count) => `${count} lines`,
    api: "The engine's interface in C++",
    apiText:
      'One include, <code>engine/engine.hpp</code>, has everything below. <code>cmake --install BUILD --component engine</code> installs it with a CMake package.',
    gallery: 'Gallery',
    galleryText: (version) =>
      `Scenes of the library in version ${version}, each drawn by <code>rigor draw</code>. <code>./rigor docs</code> makes them all.`,
    report:
      'The reference report of this version</a>: every scenario of the suite <code>standard</code> on every installed engine.',
    noReport:
      '<code>./rigor docs --report</code> also makes the reference report of this version: every scenario of the suite <code>standard</code> on every installed engine. It takes minutes, with all engines hours, and is in the folder <code>report</code> of this site.',
    command: 'command',
    part: 'Reference and gallery',
    comma: ', ',
    colon: ': ',
  },
  zh: {
    commandLine: '命令行与退出码',
    specs: '各引擎及其设置',
    specsText:
      '引擎用设置串（spec）指定：<code>NAME:key=value,key=value</code>。下面是生成本页的机器上装有的引擎；<code>./rigor list engines</code> 列出你自己的。',
    specColumns: ['键', '默认值', 'matched 预设', '含义与取值（英文）'],
    facts: (version, precisions, presets) => `版本 ${version}；精度 ${precisions}；预设 ${presets}`,
    algorithms: '本引擎的算法',
    algorithmsText: '自带引擎在一步的每个阶段可选的算法。用设置串选择，例如 rigor:solver=nsgs,substeps=4。说明为英文。',
    isDefault: '（默认）',
    scenarios: '场景库',
    sceneFacts: (dimension, bodies, duration) => [`${dimension}D`, `${bodies} 个物体`, `${duration} s`],
    reference: '参考解',
    studiesPage: '套件与研究',
    suites: '套件',
    suitesText: '供 rigor validate 使用的场景列表。',
    suiteSize: (count) => `${count} 个场景`,
    studies: '研究',
    studiesText: '供 rigor study 使用的选项组合；旁边列出 --part 可选的部分。',
    metrics: '指标',
    metricsText: '每个指标都是从轨迹到一个数的纯函数，对所有引擎相同。公式中的文字为英文。',
    metricFacts: (kind, unit) => `${chineseKinds[kind] ?? kind}，单位 ${chineseUnits[unit] ?? unit}`,
    references: '参考解',
    referencesText: '场景在 "reference" 键下引用的精确解及其出处。标题为英文。',
    source: '出处：',
    from: (file) => `正文来自 <code>${file}</code>，为英文。`,
    schemas: 'JSON 模式',
    schemasText: 'rigor check 在检查含义之前，先按这些模式检查文件。',
    lines: (count) => `${count} 行`,
    api: '引擎的 C++ 接口',
    apiText:
      '只需包含 <code>engine/engine.hpp</code>，下面的一切都在其中。<code>cmake --install BUILD --component engine</code> 安装引擎及其 CMake 包。注释为英文。',
    gallery: '图库',
    galleryText: (version) =>
      `版本 ${version} 场景库中的一些场景，均由 <code>rigor draw</code> 绘制；<code>./rigor docs</code> 一次生成全部。`,
    report: '本版本的参考报告</a>：套件 <code>standard</code> 的每个场景在每个已安装引擎上的结果（英文）。',
    noReport:
      '<code>./rigor docs --report</code> 另外生成本版本的参考报告：套件 <code>standard</code> 的每个场景在每个已安装引擎上的结果。需要几分钟，装齐所有引擎时要几小时，放在本站点的 <code>report</code> 文件夹中。',
    command: '命令',
    part: '参考与图库',
    comma: '、',
    colon: '：',
  },
};

/** Titles and headings of the documents that are pages as they stand, and of the engine's stages, in Chinese. */
export const chineseHeadings: Readonly<Record<string, string>> = {
  'The scenario format': '场景格式',
  Scenario: '场景',
  Materials: '材料',
  'Rolling and torsional friction': '滚动摩擦与扭转摩擦',
  Bodies: '物体',
  Shapes: '形状',
  'Layers and groups': '碰撞层与碰撞组',
  Joints: '关节',
  'Forces and events': '力与事件',
  Bounds: '界限',
  'Known deviations': '已知偏差',
  Generators: '生成器',
  Size: '规模',
  Bench: '性能测试',
  Overrides: '覆盖取值',
  Suites: '套件',
  Studies: '研究',
  'Collision queries': '碰撞查询',
  'The guest protocol, version 1': '外部引擎协议，第 1 版',
  'The manifest': '清单文件',
  'Life of a guest': '外部引擎的生命周期',
  Frames: '帧',
  'Requests and answers': '请求与应答',
  Errors: '错误',
  'save and restore': 'save 与 restore',
  'The scenario': '场景',
  Conventions: '约定',
  Versions: '版本',
  'The file formats of a report': '报告的文件格式',
  Tables: '表格',
  'Data files': '数据文件',
  'Replay files': '回放文件',
  'The store of results': '结果存储',
  'Orders of insertion': '插入次序',
  'Outcomes and verdicts': '结局与判定',
  'The instant of a contact': '接触的时刻',
  'Adding a column': '增加一列',
  Accuracy: '精度',
  'Relative error': '相对误差',
  Grades: '等级',
  "Comparison with the engine's scheme": '与引擎自身格式比较',
  'Adding a metric to it': '增加一个指标',
  'Where the engine ends': '引擎的局限',
  'Motion, joints and contacts': '运动、关节与接触',
  Surfaces: '表面',
  'Sensors and callbacks': '传感器与回调',
  'Heavy impacts': '猛烈碰撞',
  'Large islands': '大型岛',
  "Moreau's midpoint rule": 'Moreau 中点法则',
  'Soft joints': '软关节',
  Models: '模型',
  'What becomes of it': '对应关系',
  Export: '导出',
  'Adding a format': '增加一种格式',
  'Models that were tried': '试过的模型',
  'The Python package': 'Python 包',
  Results: '结果',
  'The engine': '引擎',
  Speed: '速度',
  Notebooks: '笔记本',
};
