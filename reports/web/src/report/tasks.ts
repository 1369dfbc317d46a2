// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What people want to simulate, in their words, and the scenarios that speak to it: by what these isolate, and by their
// names where the words are too wide. A scenario may belong to several.
import type { Scenario } from './data.ts';

export interface Task {
  key: string;
  title: string;
  about: string;
  isolates: string[]; // any of these
  names?: RegExp; // of scenarios; besides
  except?: RegExp;
}

export const tasks: Task[] = [
  {
    key: 'sliding',
    title: 'A sliding box',
    about: 'Dry friction: when a body starts to slide, how far it goes, where it stops.',
    isolates: [],
    names: /slid(e|ing)_|slide|incline_(slip|stick|return)|friction_sweep|push_sweep|cross_slope|wedge_rough|turntable/,
    except: /slider|slip_to_roll|ball|tripod_slide_off/,
  },
  {
    key: 'rolling',
    title: 'Rolling and spinning on a floor',
    about: 'From sliding to rolling, spin, balls and discs on planes.',
    isolates: ['rolling', 'rim contact'],
  },
  {
    key: 'bouncing',
    title: 'Bouncing and impact',
    about: 'Restitution, energy and momentum through collisions, the time of impact.',
    isolates: ['restitution', 'impact', 'propagation of impacts', 'time of impact', 'restitution 0'],
  },
  {
    key: 'resting',
    title: 'Stacks and things at rest',
    about: 'What should stand still stands still, and what should fall falls.',
    isolates: ['resting contact', 'manifold', 'stability', 'many contacts', 'contact forces', 'piles', 'mass ratio'],
    except: /chain/,
  },
  {
    key: 'joints',
    title: 'Joints, pendulums, mechanisms',
    about: 'Hinges, sliders, limits, motors, springs, closed loops.',
    isolates: [
      'joints',
      'hinge',
      'slider',
      'motor',
      'limit',
      'closed loop',
      'ball joint',
      'distance',
      'chain',
      'joint chain',
    ],
  },
  {
    key: 'rotation',
    title: 'Free flight and rotation',
    about: 'Integration without contacts: throws, tops, gyroscopes.',
    isolates: [
      'gyroscopic term',
      'gyroscopic torque',
      'rotation',
      'integrator',
      'integration',
      'drag',
      'gravity',
      'damping',
    ],
    except: /pendulum|hinge|slider|wheel|joint/,
  },
  {
    key: 'many',
    title: 'Many bodies',
    about: 'Piles, chains, clouds: momentum kept, no overlap, cost at size.',
    isolates: ['many bodies', 'many contacts', 'piles', 'robustness', 'stacking'],
  },
];

export const belongs = (task: Task, scenario: Scenario): boolean =>
  !task.except?.test(scenario.name) &&
  (scenario.isolates.some((word) => task.isolates.includes(word)) || (task.names?.test(scenario.name) ?? false));
