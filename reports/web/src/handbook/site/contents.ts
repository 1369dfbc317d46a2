// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of contents of the handbook (reports/handbook/contents.json) and the words of its frame in each language.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

export type Language = 'en' | 'zh';
export const languages: readonly Language[] = ['en', 'zh'];

export interface Part {
  title: Record<Language, string>;
  pages: string[]; // paths without language and extension: "build/state"
}

export interface Contents {
  title: Record<Language, string>;
  parts: Part[];
}

export const readContents = (root: string): Contents =>
  JSON.parse(readFileSync(join(root, 'reports/handbook/contents.json'), 'utf8')) as Contents;

export const pageFile = (root: string, language: Language, page: string) =>
  join(root, 'reports/handbook', language, `${page}.md`);

export const hasPage = (root: string, language: Language, page: string) => existsSync(pageFile(root, language, page));

export const words = {
  en: {
    exercise: 'Exercise',
    judge: 'Judged by:',
    look: 'Look with:',
    answer: 'Answer',
    copy: 'copy',
    contents: 'Contents',
    other: '中文',
    theme: 'Light or dark',
    play: 'Play or pause',
    back: 'One frame back',
    next: 'One frame on',
    time: 'Time',
    commands: 'Commands that repeat these runs',
    noScript: 'The scene plays with JavaScript.',
    made: 'Made from the sources of Rigor',
    quoted: 'Source file',
    filter: 'Filter',
    picture: 'Recorded run',
  },
  zh: {
    exercise: '练习',
    judge: '用下面的命令检验：',
    look: '用下面的命令观察：',
    answer: '答案',
    copy: '复制',
    contents: '目录',
    other: 'English',
    theme: '浅色或深色',
    play: '播放或暂停',
    back: '后退一帧',
    next: '前进一帧',
    time: '时间',
    commands: '重现这些运行的命令',
    noScript: '播放场景需要 JavaScript。',
    made: '由 Rigor 源码生成，版本',
    quoted: '源文件',
    filter: '筛选',
    picture: '录制的运行',
  },
} as const;
