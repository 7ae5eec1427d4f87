// Time: which moment is shown, by the slider, by keys, or by playing.

export const SPEEDS = [0.001, 0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10, 100, 1000];

export class Player {
  // `show(number)` shows a moment, and is done when it is seen.
  constructor(times, show) {
    Object.assign(this, { times, show, number: 0, speed: 1, playing: false, busy: false, loop: false, changed: () => {} });
  }

  // A speed at which the whole takes some ten seconds.
  natural() {
    const whole = this.times.at(-1) - this.times[0];
    if (!(whole > 0)) return 1;
    return SPEEDS.reduce((best, speed) => (Math.abs(Math.log(whole / speed / 10)) < Math.abs(Math.log(whole / best / 10)) ? speed : best));
  }

  // Goes to a moment. While one is on its way, the last wish counts and those between are left out.
  async go(number) {
    this.wish = Math.min(Math.max(number, 0), this.times.length - 1);
    if (this.busy) return;
    this.busy = true;
    try {
      while (this.wish !== undefined) {
        const next = this.wish;
        this.wish = undefined;
        await this.show(next);
        this.number = next;
        this.changed();
      }
    } finally {
      this.busy = false;
    }
  }

  step(by) {
    this.pause();
    return this.go((this.wish ?? this.number) + by);
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  play() {
    if (this.playing || this.times.length < 2) return;
    this.playing = true;
    let number = this.number + 1 < this.times.length ? this.number : 0;
    let [began, from] = [performance.now(), this.times[number]];
    const tick = async (now) => {
      if (!this.playing) return;
      // A frame that comes late holds the clock: nothing is leapt over because a server is slow.
      if (!this.busy) {
        const time = from + ((now - began) / 1000) * this.speed;
        let next = this.number < number ? number : this.number;
        while (next + 1 < this.times.length && this.times[next + 1] <= time) next++;
        if (next !== this.number) {
          [began, from, number] = [now, this.times[next], 0];
          await this.go(next).catch(() => this.pause());
        }
        if (next + 1 >= this.times.length) {
          if (!this.loop) return this.pause();
          // The end stays for a while before it begins anew.
          if (now - began > 1000) {
            await this.go(0).catch(() => this.pause());
            [began, from, number] = [now, this.times[0], 0];
          }
        }
      }
      requestAnimationFrame(tick);
    };
    this.changed();
    if (number === 0 && this.number !== 0) this.go(0).then(() => requestAnimationFrame(tick), () => this.pause());
    else requestAnimationFrame(tick);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
}
