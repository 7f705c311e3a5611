(* docs/certificates.md, "Windows", 1. to 3., for one atom; and the window of "never: rows along v". *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
From Lorentz Require Import Spec Time Vectors Number Steps Search Space View Quadratic Reading.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- A piece of a certificate, as it is written: in which place, its ends m 2^e, the rows of its basis.
  What
   is said of it need not be proved: whatever it is read as, the claims are checked. *)
Record end_of_window := Dyadic { mantissa : Z; exponent : Z }.
Record written_piece := WrittenPiece
  { place_in_list : Z; from_end : end_of_window; to_end : option end_of_window (* none: "inf" *);
    basis : list (list Z) }.
Definition twos (bits : Z) : Z := if bits =? 0 then 0 else Z.log2 (Z.land bits (- bits)).
Definition end_at_number (n : numeral) : option end_of_window :=
  option_map (fun i => let k := twos i in Dyadic (Z.shiftr i k) (k - 1074)) (number n).

(* As it is checked: from `begin_at` / E to `end_at` / E. For rows the ends mean nothing. *)
Record piece := Piece { begin_at : Z; end_at : option Z; r1 : zv; r2 : zv; r3 : zv }.

(* E = 2^f: the ends of all these are multiples of 1 / E. *)
Definition largest_exponent : Z := 2 ^ 14.
Definition fraction_bits (e : end_of_window) : Z := Z.min largest_exponent (- exponent e).
Definition fineness (ws : list written_piece) : Z := fold_left (fun f w =>
  Z.max (Z.max f (fraction_bits (from_end w)))
    match to_end w with Some e => fraction_bits e | None => 0 end) ws 0.
Lemma fineness_nonneg ws : 0 <= fineness ws.
Proof.
  unfold fineness. set (finer := fun f w => _). assert (K : forall f, 0 <= f -> 0 <= fold_left finer ws f);
    [|apply K; lia].
  induction ws as [|w ws IH]; cbn [fold_left]; auto. intros f Hf. apply IH. unfold finer. lia.
Qed.

Definition read_end (f : Z) (e : end_of_window) : option Z :=
  if Z.abs (exponent e) <=? largest_exponent then Some (Z.shiftl (mantissa e) (exponent e + f)) else None.
(* k numbers, and zeros; k rows, and the vectors that complete them to a basis of space. *)
Definition read_row (k : nat) (r : list Z) : option zv :=
  match k, r with
  | 0%nat, [] => Some origin
  | 1%nat, [a] => Some (V a 0 0)
  | 2%nat, [a; b] => Some (V a b 0)
  | 3%nat, [a; b; c] => Some (V a b c)
  | _, _ => None
  end.
Definition read_basis (k : nat) (rows : list (list Z)) : option (zv * zv * zv) :=
  match all_some (read_row k) rows, k with
  | Some [], 0%nat => Some (V 1 0 0, V 0 1 0, V 0 0 1)
  | Some [a], 1%nat => Some (a, V 0 1 0, V 0 0 1)
  | Some [a; b], 2%nat => Some (a, b, V 0 0 1)
  | Some [a; b; c], 3%nat => Some (a, b, c)
  | _, _ => None
  end.
Lemma read_row_ok k r n : read_row k r = Some n -> fits k n /\ r = coordinates k n.
Proof.
  unfold read_row, fits, coordinates. intros E.
  destruct k as [|[|[|[|k]]]], r as [|a [|b [|c [|d r]]]]; try discriminate; injection E as <-; cbn;
    repeat split; auto; lia.
Qed.
(* What fits is a combination of the first k alone. *)
Lemma read_basis_ok k rows r1 r2 r3 : read_basis k rows = Some (r1, r2, r3) ->
  forall n, fits k (place origin n r1 r2 r3) -> fits k n.
Proof.
  unfold read_basis. destruct (all_some (read_row k) rows) as [l|] eqn:E; [|discriminate].
  assert (F : forall a, In a l -> fits k a).
  { intros a Ha. destruct (all_some_ok _ _ _ E) as [_ K]. destruct (K a Ha) as (r & _ & Er).
    apply (read_row_ok k r a Er). }
  intros B [n1 n2 n3] (P3 & P2 & P1).
  destruct k as [|[|[|[|k]]]], l as [|a [|b [|c [|d l]]]]; try discriminate; injection B as <- <- <-;
    unfold fits, place, add, origin in *; cbn [vx vy vz In] in *; repeat split; intros;
    try (pose proof (F a ltac:(auto)) as (A3 & A2 & A1); rewrite ?A3, ?A2 in * by lia);
    try (pose proof (F b ltac:(auto)) as (B3 & B2 & B1); rewrite ?B3 in * by lia);
    try specialize (P3 ltac:(lia)); try specialize (P2 ltac:(lia)); try specialize (P1 ltac:(lia)); lia.
Qed.
Lemma first_fits k rows r1 r2 r3 : read_basis k rows = Some (r1, r2, r3) -> (1 <= k)%nat -> fits k r1.
Proof.
  unfold read_basis. destruct (all_some (read_row k) rows) as [l|] eqn:E; [|discriminate].
  intros B Hk. assert (In r1 l).
  { destruct k as [|[|[|[|k]]]], l as [|a [|b [|c [|d l]]]]; try discriminate; try lia; injection B as <- <- <-;
      left; reflexivity. }
  destruct (all_some_ok _ _ _ E) as [_ K]. destruct (K r1 H) as (r & _ & Er). apply (read_row_ok k r r1 Er).
Qed.
Definition read_piece (k : nat) (f : Z) (w : written_piece) : option piece :=
  match read_end f (from_end w), read_basis k (basis w) with
  | Some b, Some (r1, r2, r3) =>
    match to_end w with
    | Some e => option_map (fun e => Piece b (Some e) r1 r2 r3) (read_end f e)
    | None => Some (Piece b None r1 r2 r3)
    end
  | _, _ => None
  end.
Definition basis_fits (k : nat) (p : piece) : Prop := forall n, fits k (place origin n (r1 p) (r2 p) (r3 p)) -> fits k n.
Lemma read_piece_ok k f w p : read_piece k f w = Some p -> basis_fits k p.
Proof.
  unfold read_piece. destruct (read_end f (from_end w)); [|discriminate].
  destruct (read_basis k (basis w)) as [[[a b] c]|] eqn:E; [|discriminate].
  destruct (to_end w) as [e|]; [destruct (read_end f e); [|discriminate]|]; cbn; intros I; injection I as <-;
    exact (read_basis_ok k _ _ _ _ E).
Qed.
(* How many steps each piece costs before it is read. *)
Definition piece_steps : Z := 10.

Section Atom.
  Variables (f : Z) (y : seen).
  Hypothesis f_nonneg : 0 <= f.
  Let E := 2 ^ f.
  Let Q := sQ y.
  Let rank := sk y.
  Hypothesis Q_pos : 0 < Q.
  Lemma E_pos : 0 < E.
  Proof. apply Z.pow_pos_nonneg; [reflexivity|exact f_nonneg]. Qed.

  (* ---- 2. and 3.: all obstacles with s in the window that the line meets are judged. *)
  Definition check_window (judge : zv -> time -> check) (w : piece) (lo : Z) (hi : option Z) : check :=
    let b n := place origin n (s1 y) (s2 y) (s3 y) in
    require (Z.abs (det (r1 w) (r2 w) (r3 w)) =? 1) Determinant ;;
    search rank (sv y) (sw y) (sr y - 1) (b (r1 w)) (b (r2 w)) (b (r3 w)) lo hi (fun k W =>
      let D := sD y W in
      if D <=? 0 then done else judge (place origin k (r1 w) (r2 w) (r3 w)) (Time (sS y W) D Q)).

  Lemma check_window_ok judge w lo hi : basis_fits rank w -> passes (check_window judge w lo hi) ->
    forall n, fits rank n -> let W := at_cell y n in
    0 < sD y W -> in_window lo hi (sS y W) -> passes (judge n (Time (sS y W) (sD y W) Q)).
  Proof.
    intros B H n Hn W HD Hs. apply passes_both in H. destruct H as [H1 H2].
    apply passes_require, Z.eqb_eq in H1.
    destruct (unimodular n _ _ _ H1) as [k Ek]. assert (Fk : fits rank k) by (apply B; rewrite <- Ek; exact Hn).
    pose proof (search_ok _ _ _ _ _ _ _ _ _ _ H2 k Fk) as K. cbv beta zeta in K.
    assert (EW : place (sw y) k (place origin (r1 w) (s1 y) (s2 y) (s3 y)) (place origin (r2 w) (s1 y) (s2 y)
      (s3 y))
      (place origin (r3 w) (s1 y) (s2 y) (s3 y)) = W) by (unfold W, at_cell; rewrite Ek; symmetry;
        apply place_place).
    rewrite EW in K. specialize (K Hs). assert (HH : h2 (sv y) W <= sr y - 1) by (unfold sD in HD; lia).
    specialize (K HH). destruct (Z.leb_spec (sD y W) 0); [lia|]. rewrite <- Ek in K. exact K.
  Qed.

  (* ---- 1. "The atom's windows, in the order in which they are listed, leave no gap": T = s / Q, so e / E < T
     iff e Q < s E. Everything up to e has been looked at; without an end, everything. `last` checks how far this
     is at the end. *)
  Definition nearer (e : option Z) (e' : option Z) : option Z :=
    match e, e' with Some a, Some b => Some (Z.min a b) | Some a, None | None, Some a => Some a
    | None, None => None end.
  Definition farther (e : option Z) (e' : option Z) : option Z :=
    match e, e' with Some a, Some b => Some (Z.max a b) | _, _ => None end.
  Definition not_beyond (b : Z) (e : option Z) : bool := match e with Some e => b <=? e | None => true end.
  Definition window_begin (p : piece) : Z := - ((- (begin_at p * Q)) / E).
  Definition window_end (p : piece) : option Z := option_map (fun e => (e * Q) / E) (end_at p).
  Definition check_next (judge : zv -> time -> check) (e : option Z) (w : written_piece) (p : piece) : check :=
    require (not_beyond (begin_at p) (nearer e (end_at p))) (GapBefore (place_in_list w)) ;;
    check_window judge p (window_begin p) (window_end p).
  Fixpoint walk (judge : zv -> time -> check) (last : option Z -> check) (e : option Z)
    (ws : list written_piece) (left : Z) : Z + flaw :=
    match ws with
    | [] => last e left
    | w :: ws => (spend piece_steps ;; let? p := read_piece rank f w else NoVector in
        check_next judge e w p ;; walk judge last (farther e (end_at p)) ws) left
    end.
  Definition up_to (e : option Z) (s : Z) : Prop := match e with Some e => s <= e * Q | None => True end.
  Lemma walk_ok judge last ws : forall e, passes (walk judge last e ws) -> exists e', passes (last e') /\
    forall s, ~ up_to e s -> up_to e' s -> exists p, begin_at p * Q <= s /\ up_to (end_at p) s /\
      basis_fits rank p /\ passes (check_window judge p (window_begin p) (window_end p)).
  Proof.
    induction ws as [|w ws IH]; intros e H.
    - exists e. split; [exact H|]. intros s Hs Hs'. contradiction.
    - cbn [walk] in H. apply passes_both in H. destruct H as [_ H].
      destruct (read_piece rank f w) as [p|] eqn:Ep; [|apply passes_fail in H; tauto].
      apply passes_both in H. destruct H as [H1 H2]. apply passes_both in H1. destruct H1 as [H0 H1].
      apply passes_require in H0. destruct (IH _ H2) as (e' & He & K). exists e'. split; [exact He|].
      intros s Hs Hs'. destruct e as [e|]; [|destruct (Hs I)]. cbn [up_to] in Hs.
      assert (In_p : up_to (end_at p) s \/ ~ up_to (end_at p) s)
        by (destruct (end_at p); cbn [up_to]; [lia|auto]).
      destruct In_p as [Sp|Sp].
      + exists p. split; [|split; [exact Sp|split; [exact (read_piece_ok _ _ _ _ Ep)|exact H1]]].
        unfold not_beyond, nearer in H0. destruct (end_at p); apply Z.leb_le in H0; nia.
      + apply K; auto. destruct (end_at p) as [e1|]; cbn [up_to farther] in *; [nia|tauto].
  Qed.

  (* "Its `from` is at most -r/|v|": `beginning` is just below that. *)
  Definition beginning : Z := - (1 + Z.sqrt ((sr y * (E * E) - 1) / (Q * Q))).
  Lemma beginning_ok s : s * s < sr y -> beginning * Q < s * E.
  Proof.
    pose proof E_pos as EP. intros Hs. unfold beginning. set (X := sr y * (E * E) - 1).
    assert (X0 : s * s * (E * E) <= X) by (unfold X; nia). assert (0 <= X) by nia.
    assert (QQ : 0 < Q * Q) by nia.
    pose proof (Z.div_pos X (Q * Q) ltac:(auto) QQ) as D0. pose proof (Z.sqrt_spec _ D0) as [_ S].
    pose proof (Z.sqrt_nonneg (X / (Q * Q))) as M0. set (m := Z.sqrt (X / (Q * Q))) in *.
    pose proof (Z.mul_succ_div_gt X (Q * Q) QQ) as G. clearbody X.
    assert (B : X < (Z.succ m * Q) * (Z.succ m * Q)).
    { apply Z.lt_le_trans with (1 := G). replace (Z.succ m * Q * (Z.succ m * Q))
        with (Q * Q * (Z.succ m * Z.succ m)) by ring.
      apply Z.mul_le_mono_nonneg_l; lia. }
    destruct (Z_lt_le_dec (- (Z.succ m * Q)) (s * E)) as [L|L]; [lia|exfalso].
    assert (0 <= Z.succ m * Q) by nia. assert (Z.succ m * Q <= - (s * E)) by lia.
    assert (Z.succ m * Q * (Z.succ m * Q) <= - (s * E) * - (s * E)) by (apply Z.mul_le_mono_nonneg; lia). lia.
  Qed.

  (* "One of the `to` is at least t_X + r/|v|": this end, less r/|v|, is compared with `until`. *)
  Definition reaches (e : Z) (until : time) : bool :=
    match order (Time (e * Q) (sr y * (E * E)) (Q * E)) until with Lt => false | _ => true end.
  Lemma reaches_ok e until s D : regular until -> reaches e until = true -> 0 <= D <= sr y ->
    (time_value (Time s D Q) <= time_value until)%R -> s * E <= e * Q.
  Proof.
    pose proof E_pos as EP. intros Hu K HD HV. pose proof (order_ok (Time (e * Q) (sr y * (E * E)) (Q * E))
      until) as O.
    assert (EE : 0 < E * E) by nia.
    assert (Rg : regular (Time (e * Q) (sr y * (E * E)) (Q * E))).
    { split; cbn [td tq]; [apply Z.mul_nonneg_nonneg; lia|apply Z.mul_pos_pos; auto]. }
    specialize (O Rg Hu). unfold reaches in K.
    assert (V : (time_value (Time s D Q) <= time_value (Time (e * Q) (sr y * (E * E)) (Q * E)))%R).
    { destruct (order _ until); try discriminate; simpl in O; lra. }
    clear O K HV Rg. unfold time_value in V; cbn [ts td tq] in V. rewrite sqrt_scale in V by lia.
    rewrite !mult_IZR in V.
    apply le_IZR. rewrite !mult_IZR.
    assert (QP : (0 < IZR Q)%R) by (apply IZR_lt; auto). assert (EP' : (0 < IZR E)%R) by (apply IZR_lt; auto).
    assert (RP : (sqrt (IZR D) <= sqrt (IZR (sr y)))%R) by (apply sqrt_le_1_alt, IZR_le; lia).
    set (q := IZR Q) in *. set (ee := IZR E) in *. set (sd := sqrt (IZR D)) in *.
    set (sq := sqrt (IZR (sr y))) in *.
    replace ((IZR e * q - sq * ee) / (q * ee))%R with ((IZR e * q / ee - sq) / q)%R in V by (field; lra).
    apply Rmult_le_reg_r in V; [|apply Rinv_0_lt_compat; auto].
    assert (W : (IZR s <= IZR e * q / ee)%R) by lra.
    apply Rmult_le_compat_r with (r := ee) in W; [|lra]. unfold Rdiv in W.
    rewrite Rmult_assoc, Rinv_l in W; lra.
  Qed.

  (* ---- All obstacles of the atom that contain x, or are entered in the span. *)
  Inductive span := Nothing | Until (t : time) | Forever.
  Definition spans (e : option Z) (asked : span) : bool :=
    match asked, e with
    | Nothing, _ | _, None => true
    | Until t, Some e => reaches e t
    | Forever, Some _ => false
    end.
  Definition spanned (asked : span) (t : time) : Prop :=
    match asked with
    | Nothing => False
    | Until u => regular u /\ (time_value t <= time_value u)%R
    | Forever => True
    end.
  Definition check_windows_in (ws : list written_piece) (asked : span) (gap : flaw)
    (judge : zv -> time -> check) : check :=
    walk judge (fun e => require (spans e asked) gap) (Some beginning) ws.
  Lemma check_windows_in_ok ws asked gap judge : passes (check_windows_in ws asked gap judge) ->
    forall n, fits rank n -> let W := at_cell y n in let s := sS y W in let D := sD y W in
    0 < D -> 0 < s \/ s * s < D -> spanned asked (Time s D Q) -> passes (judge n (Time s D Q)).
  Proof.
    intros H n Hn W s D HD Hs HV. destruct (walk_ok _ _ _ _ H) as (e & H2 & K). apply passes_require in H2.
    pose proof E_pos as EP.
    assert (HDR : D <= sr y) by (unfold D, sD; pose proof (h2_nonneg (sv y) W); lia).
    destruct (K (s * E)) as (p & Hb & He & B & Hp).
    - cbn [up_to]. destruct Hs as [Hs|Hs]; [|pose proof (beginning_ok s ltac:(lia)); lia].
      assert (beginning * Q < 0 * E) by (apply beginning_ok; lia).
      assert (0 < s * E) by (apply Z.mul_pos_pos; auto). lia.
    - destruct e as [e|]; [|exact I]. cbn [up_to]. destruct asked as [|u|]; cbn in H2, HV; try tauto;
        try discriminate. apply (reaches_ok e u s D); try tauto. lia.
    - apply (check_window_ok _ _ _ _ B Hp); auto. fold W. fold s. unfold window_begin, window_end. split.
      + apply Z.opp_le_mono. rewrite Z.opp_involutive. apply Z.div_le_lower_bound; auto. lia.
      + destruct (end_at p) as [e1|]; cbn [option_map up_to] in *; [|exact I].
        apply Z.div_le_lower_bound; auto. lia.
  Qed.

  (* ---- never: b_1 is parallel to v. "So all obstacles of a row have the same h". One obstacle of each row has
     0 <= s <= |s_1|. *)
  Definition check_piece_of_row (w : piece) (met : zv -> flaw) : check :=
    let b1 := place origin (r1 w) (s1 y) (s2 y) (s3 y) in let s1 := sS y b1 in let c := cross (sv y) b1 in
    require ((vx c =? 0) && (vy c =? 0) && (vz c =? 0) && negb (s1 =? 0)) NotAlong ;;
    check_window (fun n _ => fail (met n)) w 0 (Some (Z.abs s1)).
  Lemma check_piece_of_row_ok w met : basis_fits rank w -> fits rank (r1 w) ->
    passes (check_piece_of_row w met) -> forall n, fits rank n -> ~ 0 < sD y (at_cell y n).
  Proof.
    intros B F1 H n Hn Dp. apply passes_both in H. destruct H as [H Hw]. apply passes_require in H.
    rewrite !Bool.andb_true_iff, !Bool.negb_true_iff, !Z.eqb_eq, Z.eqb_neq in H.
    destruct H as [[[Hx Hy] Hz] Hs1].
    set (b1 := place origin (r1 w) (s1 y) (s2 y) (s3 y)) in *. set (step := sS y b1) in *.
    set (W := at_cell y n) in *.
    assert (B0 : cross (sv y) b1 = V 0 0 0) by (apply zv_eq; auto).
    assert (exists m, 0 <= sS y W + m * step <= Z.abs step) as [m Hm].
    { set (s := sS y W). destruct (Z_lt_le_dec 0 step) as [P|N].
      - exists (- (s / step)). pose proof (Z.mod_pos_bound s step P). pose proof (Z.div_mod s step Hs1). lia.
      - exists (s / - step). assert (P : 0 < - step) by lia. pose proof (Z.mod_pos_bound s (- step) P).
        pose proof (Z.div_mod s (- step) ltac:(lia)). lia. }
    assert (EW : at_cell y (add n m (r1 w)) = add W m b1) by apply place_step.
    assert (Sm : sS y (add W m b1) = sS y W + m * step) by apply dot_add.
    assert (Dm : sD y (add W m b1) = sD y W).
    { unfold sD. rewrite h2_add, B0, lagrange. unfold dot; cbn [vx vy vz]. ring. }
    pose proof (check_window_ok _ _ _ _ B Hw (add n m (r1 w))) as K. cbv zeta in K. rewrite EW, Sm, Dm in K.
    apply (passes_fail (met (add n m (r1 w)))), K; auto.
    destruct Hn as (N3 & N2 & N1), F1 as (R3 & R2 & R1). unfold fits, add; cbn [vx vy vz].
    repeat split; intros; rewrite ?N3, ?N2, ?N1, ?R3, ?R2, ?R1 by lia; ring.
  Qed.
End Atom.

(* With these windows; with this row. *)
Definition check_windows (y : seen) (ws : list written_piece) : span -> flaw -> (zv -> time -> check) -> check :=
  check_windows_in (fineness ws) y ws.
Lemma check_windows_ok y ws asked gap judge : 0 < sQ y -> passes (check_windows y ws asked gap judge) ->
  forall n, fits (sk y) n -> let W := at_cell y n in let s := sS y W in let D := sD y W in
  0 < D -> 0 < s \/ s * s < D -> spanned asked (Time s D (sQ y)) -> passes (judge n (Time s D (sQ y))).
Proof. intros HQ. apply check_windows_in_ok; [apply fineness_nonneg|exact HQ]. Qed.

Definition check_row (y : seen) (w : written_piece) (met : zv -> flaw) : check :=
  spend piece_steps ;; let? b := read_basis (sk y) (basis w) else NoVector in
  let '(r1, r2, r3) := b in require (1 <=? sk y)%nat NotAlong ;; check_piece_of_row y (Piece 0 None r1 r2 r3) met.
Lemma check_row_ok y w met : passes (check_row y w met) -> forall n, fits (sk y) n -> ~ 0 < sD y (at_cell y n).
Proof.
  intros H. apply passes_both in H. destruct H as [_ H].
  destruct (read_basis (sk y) (basis w)) as [[[r1 r2] r3]|] eqn:E; [|apply passes_fail in H; tauto].
  apply passes_both in H. destruct H as [H0 H]. apply passes_require, Nat.leb_le in H0.
  eapply (check_piece_of_row_ok 0); [apply Z.le_refl| | |exact H].
  - exact (read_basis_ok _ _ _ _ _ E).
  - apply (first_fits _ _ _ _ _ E H0).
Qed.
