/** The time that the mechanism and all plots share, and how it runs. */
export class Clock {
  readonly start: number;
  readonly end: number;
  t = $state(0);
  playing = $state(false);
  speed = $state(1);
  /** −1 where it runs backwards. */
  direction = $state<1 | -1>(1);
  loop = $state(false);

  constructor(private readonly times: number[]) {
    this.start = times[0];
    this.end = times[times.length - 1];
    this.t = this.start;
    this.speed = this.usualSpeed;
  }

  get lasting(): number {
    return this.end - this.start;
  }

  /** From 0 at the start to 1 at the end. */
  get part(): number {
    return this.partOf(this.t);
  }

  partOf(t: number): number {
    return this.lasting > 0 ? (t - this.start) / this.lasting : 0;
  }

  /** Life's own where the run then takes some seconds, else a power of ten at which it takes about eight. */
  get usualSpeed(): number {
    return this.lasting >= 2 && this.lasting <= 30 ? 1 : 10 ** Math.round(Math.log10(Math.max(this.lasting, 1e-9) / 8));
  }

  /** Digits behind the point that show a thousandth of the run. */
  get digits(): number {
    return Math.min(9, Math.max(2, Math.ceil(3 - Math.log10(Math.max(this.lasting, 1e-9)))));
  }

  seek(t: number): void {
    this.t = Math.min(Math.max(t, this.start), this.end);
  }

  /** Stops there. */
  stopAt(t: number): void {
    this.playing = false;
    this.seek(t);
  }

  /** To the next or the last of ascending times. */
  stepTo(times: number[], way: 1 | -1): void {
    const room = 1e-9 * this.lasting;
    const next = way > 0 ? times.find((t) => t > this.t + room) : times.findLast((t) => t < this.t - room);
    this.stopAt(next ?? (way > 0 ? this.end : this.start));
  }

  stepFrame(way: 1 | -1): void {
    this.stepTo(this.times, way);
  }

  toggle(): void {
    this.playing = !this.playing;
    if (!this.playing) return;
    if (this.over) this.rewind();
    requestAnimationFrame((now) => this.run(now));
  }

  private get over(): boolean {
    return this.direction > 0 ? this.t >= this.end : this.t <= this.start;
  }

  private rewind(): void {
    this.t = this.direction > 0 ? this.start : this.end;
  }

  private run(last: number): void {
    requestAnimationFrame((now) => {
      if (!this.playing) return;
      this.seek(this.t + (this.direction * this.speed * (now - last)) / 1000);
      if (this.over && this.loop) this.rewind();
      if (this.over) this.playing = false;
      else this.run(now);
    });
  }
}
