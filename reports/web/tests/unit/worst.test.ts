// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { placeQuery, placeTime, worstPlace } from '../../src/report/worst.ts';

test('the worst of one audit names pair, time and what was wrong', () => {
  assert.deepEqual(worstPlace('right|stone_3 at t=0.883333 (normal)'), {
    pair: 'right|stone_3',
    bodies: ['right', 'stone_3'],
    time: 0.883333,
    step: null,
    contact: null,
    dt: null,
    what: 'normal',
    spec: '',
  });
});

test('the step identifies the frame where the digits of the time end before it', () => {
  const place = worstPlace('a|b at t=0.883333, step 53 (spurious, far apart)');
  assert.ok(place);
  assert.equal(place.step, 53);
  assert.equal(place.what, 'spurious, far apart');
  assert.equal(place.spec, '');
  assert.equal(placeTime(place, 1 / 60), 53 / 60);
  assert.deepEqual(placeQuery(place, 1 / 60), {
    dt: 1 / 60,
    t: 0.883333,
    step: 53,
    pair: 'a|b',
    contact: null,
    finding: null,
  });
});

test('the contact is identified among all of its frame', () => {
  const place = worstPlace('a|b at t=0.25, step 15, contact 12 (normal) (ode:preset=matched) (dt=0.01)');
  assert.ok(place);
  assert.equal(place.contact, 12);
  assert.equal(place.what, 'normal');
  assert.equal(place.spec, 'ode:preset=matched');
  assert.equal(placeQuery(place, undefined).contact, 12);
  assert.equal(placeQuery(place, undefined).finding, 'in_run~normal');
  assert.equal(placeQuery(place, undefined, 'fcl').finding, 'fcl~normal');
});

test('gathered over runs it also names the run', () => {
  const place = worstPlace('a|b at t=1e-05 (missed) (bullet:preset=default,solver=mlcp) (dt=0.016666666666666666)');
  assert.equal(place?.what, 'missed');
  assert.equal(place?.spec, 'bullet:preset=default,solver=mlcp');
  assert.equal(place?.time, 1e-5);
  assert.equal(place?.dt, 1 / 60);
  assert.equal(placeQuery(place, undefined).dt, 1 / 60);
  assert.equal(worstPlace('a|b at t=2 (ode:preset=matched)')?.spec, 'ode:preset=matched');
});

test('what names no time is no place', () => {
  assert.equal(worstPlace(''), null);
  assert.equal(worstPlace('a|b'), null);
});
